# What clast --version tells of the source and of the parts built in: cmake -DOUT=clast_source.h -DSOURCE=FOLDER -DHAS="a, b" -DLACKS=c -P Source.cmake.
# The commit is git's, with "-dirty" where files have changed since, or that which git archive wrote into cmake/commit; a file that stays
# the same keeps its time, so that nothing is compiled anew.
set(id "")
if(EXISTS "${SOURCE}/.git")
  execute_process(COMMAND git -C "${SOURCE}" rev-parse --short=12 HEAD OUTPUT_VARIABLE id OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND git --no-optional-locks -C "${SOURCE}" status --porcelain --untracked-files=no OUTPUT_VARIABLE changed ERROR_QUIET)
  if(id AND changed)
    string(APPEND id "-dirty")
  endif()
else()
  file(STRINGS "${SOURCE}/cmake/commit" commit LIMIT_COUNT 1)
  if(commit MATCHES "^[0-9a-f]+$")
    string(SUBSTRING "${commit}" 0 12 id)
  endif()
endif()
if(NOT id)
  set(id "unknown")
endif()
file(CONFIGURE OUTPUT "${OUT}" CONTENT [[// Made by cmake/Source.cmake.
#pragma once
#define CLAST_SOURCE "@id@"
#define CLAST_HAS "@HAS@"
#define CLAST_LACKS "@LACKS@"
]] @ONLY NEWLINE_STYLE LF)
