#include "io/shape_word.h"

#include "aggregate/config.h"
#include "base/status.h"
#include <math.h>
#include <string.h>

static const char PREFIX[] = "ellipsoid:";

bool clx_is_ellipsoid_word(const char *text)
{
    return strncmp(text, PREFIX, strlen(PREFIX)) == 0;
}

clast_status clx_ellipsoid_word(const char *text, const char *name, clast_shape *shape)
{
    double axes[3];
    if (clx_numbers_parse(text + strlen(PREFIX), 3, axes) != CLAST_OK ||
        fmin(axes[0], fmin(axes[1], axes[2])) <= 0.0) {
        return clx_fail(CLAST_E_CONFIG,
                        "'%s': write ellipsoid:a,b,c with three numbers above 0, the ratios of its "
                        "axes: they have no unit, and the grain's size is given by itself",
                        text);
    }
    for (int k = 0; k < 3; ++k) {
        axes[k] *= 0.5;
    }
    return clast_shape_ellipsoid(name, axes, shape);
}
