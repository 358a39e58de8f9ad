// Time integration of the sectional balance: backward differences with dense Newton steps by
// CVODE [Cohen1996; Hindmarsh2005], where this build has it. docs/adr/0005-sundials.md
#include "cloud/sectional.h"

#include "base/monitor.h"
#include <math.h>

#if CLAST_HAVE_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static const double LEAST_SHARE = 1e-14; ///< of the monomers: absolute tolerance
static const double GEL_SHARE = 1e-3;    ///< of the monomers above the grid: told as lost
enum { MOST_STEPS = 200000 };

typedef struct {
    SUNContext context;
    void *cvode;
    N_Vector y;
    SUNMatrix matrix;
    SUNLinearSolver linear;
    clx_sectional *s;
    char words[256]; ///< of CVODE's last complaint
} integrator;

static int slope(sunrealtype t, N_Vector y, N_Vector rate, void *context)
{
    const integrator *g = context;
    (void)t;
    clx_sectional_slope(g->s, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
    return 0;
}

// NOLINTNEXTLINE(readability-function-size): CVODE's own signature
static int jacobian(sunrealtype t, N_Vector y, N_Vector rate, SUNMatrix matrix, void *context,
                    N_Vector a, N_Vector b, N_Vector c)
{
    const integrator *g = context;
    (void)t;
    (void)rate;
    (void)a;
    (void)b;
    (void)c;
    clx_sectional_jacobian(g->s, N_VGetArrayPointer(y), SUNDenseMatrix_Cols(matrix));
    return 0;
}

static int has_left(sunrealtype t, N_Vector y, sunrealtype *root, void *context)
{
    const integrator *g = context;
    (void)t;
    root[0] = N_VGetArrayPointer(y)[g->s->n + CLX_GEL] - GEL_SHARE;
    return 0;
}

static void keep_complaint(integrator *g, const char *words)
{
    (void)snprintf(g->words, sizeof g->words, "%s", words);
    for (char *at = strchr(g->words, '\n'); at != NULL; at = strchr(at, '\n')) {
        *at = ' ';
    }
}

// SUNDIALS 7 has communicators of a type of their own, and its context takes the complaints.
#if SUNDIALS_VERSION_MAJOR < 7
#define SUN_COMM_NULL NULL
static void keep_words(int code, const char *module, const char *function, char *words, void *g)
{
    (void)code;
    (void)module;
    (void)function;
    keep_complaint(g, words);
}

static bool listens(integrator *g)
{
    return CVodeSetErrHandlerFn(g->cvode, keep_words, g) == CV_SUCCESS;
}
#else
// NOLINTNEXTLINE(readability-function-size): CVODE's own signature
static void keep_words(int line, const char *function, const char *file, const char *words,
                       SUNErrCode code, void *g, SUNContext context)
{
    (void)line;
    (void)function;
    (void)file;
    (void)code;
    (void)context;
    keep_complaint(g, words);
}

static bool listens(integrator *g)
{
    return SUNContext_ClearErrHandlers(g->context) == SUN_SUCCESS &&
           SUNContext_PushErrHandler(g->context, keep_words, g) == SUN_SUCCESS;
}
#endif

static void integrator_free(integrator *g)
{
    CVodeFree(&g->cvode);
    (void)(g->linear != NULL ? SUNLinSolFree(g->linear) : 0);
    SUNMatDestroy(g->matrix);
    if (g->y != NULL) {
        N_VDestroy(g->y);
    }
    (void)SUNContext_Free(&g->context);
}

static clast_status integrator_begin(integrator *g, double *first, double tolerance)
{
    clast_status status = CLAST_OK;
    const sunindextype n = g->s->n + CLX_N_BESIDE;
    CLX_CHECK(SUNContext_Create(SUN_COMM_NULL, &g->context) == 0, CLAST_E_MEMORY,
              "CVODE did not begin");
    g->y = N_VNew_Serial(n, g->context);
    g->matrix = SUNDenseMatrix(n, n, g->context);
    g->cvode = CVodeCreate(CV_BDF, g->context);
    CLX_CHECK(g->y != NULL && g->matrix != NULL && g->cvode != NULL, CLAST_E_MEMORY,
              "not enough memory for %lld sections", (long long)n);
    memcpy(N_VGetArrayPointer(g->y), first, (size_t)n * sizeof *first);
    g->linear = SUNLinSol_Dense(g->y, g->matrix, g->context);
    CLX_CHECK(g->linear != NULL && CVodeInit(g->cvode, slope, 0.0, g->y) == CV_SUCCESS &&
                  CVodeSetUserData(g->cvode, g) == CV_SUCCESS && listens(g) &&
                  CVodeSStolerances(g->cvode, tolerance, LEAST_SHARE) == CV_SUCCESS &&
                  CVodeSetLinearSolver(g->cvode, g->linear, g->matrix) == CV_SUCCESS &&
                  CVodeSetJacFn(g->cvode, jacobian) == CV_SUCCESS &&
                  CVodeSetMaxNumSteps(g->cvode, MOST_STEPS) == CV_SUCCESS &&
                  CVodeRootInit(g->cvode, 1, has_left) == CV_SUCCESS,
              CLAST_E_MEMORY, "CVODE did not begin: %s", g->words);
done:
    return status;
}

clast_status clx_sectional_solve(clx_sectional *s, const clast_spectrum_config *config,
                                 const clast_monitor *monitor, double *rows, double *gel_time)
{
    clast_status status = CLAST_OK;
    integrator g = {.s = s};
    const size_t n = (size_t)s->n + CLX_N_BESIDE;
    double time = 0.0;
    *gel_time = (double)NAN;
    CLX_TRY(integrator_begin(&g, rows, config->tolerance));
    for (int32_t step = 1; step <= config->n_step; ++step) {
        const double end = config->duration / config->n_step * step;
        CLX_CHECK(!clx_monitor_stops(monitor), CLAST_E_STOPPED,
                  "stopped after %d of %d steps; nothing is kept", step - 1, config->n_step);
        for (int code = CV_ROOT_RETURN; code == CV_ROOT_RETURN && time < end;) {
            code = CVode(g.cvode, end, g.y, &time, CV_NORMAL);
            CLX_CHECK(code >= 0, CLAST_E_CONVERGE, "the spectrum was integrated up to %s of %s: %s",
                      clx_unit_text(time, "s"), clx_unit_text(config->duration, "s"), g.words);
            if (code == CV_ROOT_RETURN && isnan(*gel_time)) {
                *gel_time = time;
            }
        }
        for (size_t i = 0; i < n; ++i) { // below the tolerance a share has no sign
            const double share = N_VGetArrayPointer(g.y)[i];
            rows[(size_t)step * n + i] = fabs(share) < LEAST_SHARE ? fmax(0.0, share) : share;
        }
        clx_monitor_report(monitor, "steps", step, config->n_step);
    }
done:
    integrator_free(&g);
    return status;
}

bool clast_spectrum_has_sectional(void)
{
    return true;
}

#else

clast_status clx_sectional_solve(clx_sectional *s, const clast_spectrum_config *config,
                                 const clast_monitor *monitor, double *rows, double *gel_time)
{
    (void)s;
    (void)config;
    (void)monitor;
    (void)rows;
    (void)gel_time;
    return clx_fail(CLAST_E_CONFIG,
                    "solver: this clast was built without SUNDIALS, so there is no sectional one; "
                    "take --solver monte-carlo, or build again with it (tools/setup.sh sundials)");
}

bool clast_spectrum_has_sectional(void)
{
    return false;
}

#endif
