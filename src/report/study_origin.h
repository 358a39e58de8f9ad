#pragma once
// Where the runs of a study came from.
#include "base/status.h"
#include <jansson.h>

typedef struct clx_run clx_run;

/// What stands for a study's manifest, of its study.json and the manifests of its runs: command,
/// version or versions of clast, configuration, inputs. Its tables have been read.
clast_status clx_study_origin(const clx_run *run, const json_t *study, json_t **manifest);
