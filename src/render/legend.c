// What a grain's colour means.
#include "render/legend.h"

#include "base/number.h"
#include "math/colour.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <stdio.h>
#include <string.h>

clx_length_unit clx_length_unit_for(double length, double metre_per_unit)
{
    static const struct {
        double metre;
        const char *name;
    } units[] = {{1e-9, "nm"}, {1e-6, "\u00b5m"}, {1e-3, "mm"}, {1.0, "m"}, {1e3, "km"}};
    size_t best = 0;
    if (metre_per_unit <= 0.0) {
        return (clx_length_unit){1.0, ""};
    }
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i) {
        best = length * metre_per_unit >= 0.9995 * units[i].metre ? i : best;
    }
    return (clx_length_unit){metre_per_unit / units[best].metre, units[best].name};
}

/// The map without its darkest end and paled a little: on black, light and shade cannot be told
/// apart. Lightness still rises evenly along it.
void clx_legend_colour(double t, double rgb[3])
{
    const double pale = 0.10;
    clx_colour_sequence(0.10 + 0.90 * t, rgb);
    for (int k = 0; k < 3; ++k) {
        rgb[k] += pale * (1.0 - rgb[k]);
    }
}

static double linear_light(double s)
{
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

static void set_albedo(clx_scene *scene, int32_t g, const double rgb[3])
{
    for (int k = 0; scene != NULL && k < 3; ++k) {
        scene->grain[g].albedo[k] = linear_light(rgb[k]);
    }
}

/// Diameter of the sphere of a grain's volume.
static double size_of(const clast_assembly *assembly, int32_t g)
{
    CLAST_ASSERT(g >= 0 && g < assembly->n_grain);
    const double volume = assembly->shape[assembly->shape_id[g]].volume;
    return assembly->scale[g] * cbrt(6.0 * fmax(volume, 0.0) / CLAST_PI);
}

static void size_range(const clast_assembly *assembly, double *low, double *high)
{
    *low = INFINITY;
    *high = 0.0;
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        *low = fmin(*low, size_of(assembly, g));
        *high = fmax(*high, size_of(assembly, g));
    }
}

static void add_tick(clx_legend *legend, double value)
{
    CLAST_ASSERT(legend->n >= 0 && legend->n <= CLX_LEGEND_TICKS);
    const double a = legend->log ? log(legend->low) : legend->low;
    const double b = legend->log ? log(legend->high) : legend->high;
    const double v = legend->log ? log(value) : value;
    const double place = b > a ? (v - a) / (b - a) : 0.5;
    if (legend->n < CLX_LEGEND_TICKS && place >= -1e-9 && place <= 1.0 + 1e-9) {
        legend->place[legend->n] = fmin(fmax(place, 0.0), 1.0);
        (void)clx_number_print(legend->text[legend->n++], CLX_LEGEND_TEXT, "%.10g", value);
    }
}

/// Multiples of 1, 2 or 5 times a power of ten, four to eight of them.
static void linear_ticks(clx_legend *legend)
{
    const double rough = (legend->high - legend->low) / 5.0;
    const double power = pow(10.0, floor(log10(rough)));
    const double digit = rough / power;
    const double step = power * (digit > 3.5 ? 5.0 : digit > 1.5 ? 2.0 : 1.0);
    const double first = ceil(legend->low / step - 1e-9);
    for (int i = 0; i < CLX_LEGEND_TICKS; ++i) {
        add_tick(legend, (first + i) * step);
    }
}

/// Powers of ten, with 2 and 5 between when there are few.
static void log_ticks(clx_legend *legend)
{
    const double decades = log10(legend->high / legend->low);
    const int stride = (int)fmax(1.0, ceil(decades / 8.0));
    for (int p = (int)floor(log10(legend->low)); p <= (int)ceil(log10(legend->high)); ++p) {
        if (p % stride != 0) {
            continue;
        }
        add_tick(legend, pow(10.0, p));
        if (decades < 4.0) {
            add_tick(legend, 2.0 * pow(10.0, p));
            add_tick(legend, 5.0 * pow(10.0, p));
        }
    }
}

static void make_ticks(clx_legend *legend)
{
    if (!(legend->high > legend->low * (1.0 + 1e-9))) { // no round number is in reach
        add_tick(legend, legend->low);
        (void)clx_number_print(legend->text[0], CLX_LEGEND_TEXT, "%.4g", legend->low);
        return;
    }
    if (legend->log) {
        log_ticks(legend);
    }
    if (legend->n < 3) {
        legend->n = 0;
        if (!legend->log) {
            linear_ticks(legend);
            return;
        }
        // Less than a decade: round numbers evenly spaced in value still read best.
        clx_legend even = *legend;
        linear_ticks(&even);
        *legend = even;
    }
}

/// Place of a value on the bar.
static double place_of(const clx_legend *legend, double value)
{
    if (!(legend->high > legend->low)) {
        return 0.5;
    }
    return legend->log ? log(value / legend->low) / log(legend->high / legend->low)
                       : (value - legend->low) / (legend->high - legend->low);
}

static bool wants_log(const clast_render_config *config, double low, double high)
{
    return config->scale == CLAST_RENDER_SCALE_LOG ||
           (config->scale == CLAST_RENDER_SCALE_AUTO && low > 0.0 && high > 4.0 * low);
}

static clast_status colour_by_size(const clast_assembly *assembly,
                                   const clast_render_config *config, double metre_per_unit,
                                   clx_scene *scene, clx_legend *legend)
{
    clast_status status = CLAST_OK;
    size_range(assembly, &legend->low, &legend->high);
    CLX_CHECK(legend->low > 0.0, CLAST_E_GEOMETRY,
              "a grain has no volume, so it cannot be coloured by size");
    const clx_length_unit unit = clx_length_unit_for(legend->high, metre_per_unit);
    legend->kind = CLX_LEGEND_BAR;
    legend->factor = unit.factor;
    legend->low *= unit.factor;
    legend->high *= unit.factor;
    legend->log = wants_log(config, legend->low, legend->high);
    (void)snprintf(legend->title, sizeof legend->title, "equivalent diameter%s%s%s",
                   unit.name[0] != '\0' ? " (" : "", unit.name, unit.name[0] != '\0' ? ")" : "");
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        double rgb[3];
        clx_legend_colour(place_of(legend, size_of(assembly, g) * unit.factor), rgb);
        set_albedo(scene, g, rgb);
    }
    make_ticks(legend);
done:
    return status;
}

static void colour_by_order(const clast_assembly *assembly, const clast_render_config *config,
                            clx_scene *scene, clx_legend *legend)
{
    legend->kind = CLX_LEGEND_BAR;
    legend->low = 1.0;
    legend->high = assembly->n_grain;
    legend->log = config->scale == CLAST_RENDER_SCALE_LOG;
    (void)snprintf(legend->title, sizeof legend->title, "order of arrival");
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        double rgb[3];
        clx_legend_colour(place_of(legend, g + 1.0), rgb);
        set_albedo(scene, g, rgb);
    }
    make_ticks(legend);
    // The ends are named; round numbers too close to them give way.
    const double apart = 0.09;
    int n = 0;
    for (int i = 0; i < legend->n && n < CLX_LEGEND_TICKS - 2; ++i) {
        if (legend->place[i] > apart && legend->place[i] < 1.0 - apart) {
            legend->place[n] = legend->place[i];
            memmove(legend->text[n++], legend->text[i], CLX_LEGEND_TEXT);
        }
    }
    legend->n = n;
    add_tick(legend, legend->low);
    if (assembly->n_grain > 1) {
        add_tick(legend, legend->high);
    }
}

/// A name as it can be drawn, of so many characters at most.
static void shorten(const char *name, char text[CLX_LEGEND_TEXT])
{
    enum { MOST = 38 };
    int n = 0;
    char *cut = NULL;
    (void)clast_text_printable(name, CLX_LEGEND_TEXT - 4, text);
    for (char *c = text; *c != '\0'; ++c) {
        if (((unsigned char)*c & 0xc0U) != 0x80U && ++n == MOST) { // a character begins
            cut = c;
        }
    }
    if (n > MOST) {
        memcpy(cut, "\u2026", sizeof "\u2026");
    }
}

static void colour_by_shape(const clast_assembly *assembly, clx_scene *scene, clx_legend *legend)
{
    static const int order[CLX_LEGEND_SHAPES] = {4, 5, 2, 1, 3, 0, 7, -1};
    legend->kind = CLX_LEGEND_LIST;
    (void)snprintf(legend->title, sizeof legend->title, "shape");
    for (int32_t s = 0; s < assembly->n_shape && s < CLX_LEGEND_SHAPES; ++s) {
        const char *name = assembly->shape[s].name;
        clx_colour_category(order[s], legend->rgb[s]);
        shorten(name != NULL ? name : "", legend->text[s]);
        legend->n = s + 1;
    }
    if (assembly->n_shape > CLX_LEGEND_SHAPES) {
        (void)snprintf(legend->text[CLX_LEGEND_SHAPES - 1], CLX_LEGEND_TEXT, "%d others",
                       assembly->n_shape - CLX_LEGEND_SHAPES + 1);
    }
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        double rgb[3];
        const int32_t s = assembly->shape_id[g];
        clx_colour_category(order[s < CLX_LEGEND_SHAPES ? s : CLX_LEGEND_SHAPES - 1], rgb);
        set_albedo(scene, g, rgb);
    }
}

/// "#c8b89a" as numbers 0 to 1; false for anything else.
static bool parse_colour(const char *text, double rgb[3])
{
    static const char digits[] = "0123456789abcdef";
    if (strlen(text) != 7 || text[0] != '#') {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        const char *high = strchr(digits, text[2 * k + 1] | 0x20);
        const char *low = strchr(digits, text[2 * k + 2] | 0x20);
        if (high == NULL || low == NULL) {
            return false;
        }
        rgb[k] = (double)(16 * (high - digits) + (low - digits)) / 255.0;
    }
    return true;
}

static clast_status colour_all(const clast_assembly *assembly, const char *tint, clx_scene *scene)
{
    double rgb[3];
    if (!parse_colour(tint, rgb)) {
        return clx_fail(CLAST_E_CONFIG,
                        "tint '%s' is not a colour; write it as #rrggbb, like #c8b89a", tint);
    }
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        set_albedo(scene, g, rgb);
    }
    return CLAST_OK;
}

clast_status clx_legend_make(const clast_assembly *assembly, const clast_render_config *config,
                             double metre_per_unit, clx_scene *scene, clx_legend *legend)
{
    int32_t colour = config->colour;
    clx_legend made = {.kind = CLX_LEGEND_NONE};
    if (colour == CLAST_RENDER_COLOUR_AUTO) {
        double low = 0.0;
        double high = 0.0;
        size_range(assembly, &low, &high);
        colour =
            low > 0.0 && high > 1.01 * low ? CLAST_RENDER_COLOUR_SIZE : CLAST_RENDER_COLOUR_SINGLE;
        if (colour == CLAST_RENDER_COLOUR_SIZE &&
            !clast_field_is_default(clast_fields_find(clast_render_fields, "tint"), config)) {
            return clx_fail(CLAST_E_CONFIG, "tint does nothing where colours show sizes, which "
                                            "differ here; give colour single with it");
        }
    }
    clast_status status = CLAST_OK;
    if (colour == CLAST_RENDER_COLOUR_SIZE) {
        status = colour_by_size(assembly, config, metre_per_unit, scene, &made);
    } else if (colour == CLAST_RENDER_COLOUR_ORDER) {
        colour_by_order(assembly, config, scene, &made);
    } else if (colour == CLAST_RENDER_COLOUR_SHAPE) {
        colour_by_shape(assembly, scene, &made);
    } else {
        status = colour_all(assembly, config->tint, scene);
    }
    if (status == CLAST_OK) {
        *legend = made;
        if (!config->colour_bar) {
            legend->kind = CLX_LEGEND_NONE;
        }
    }
    return status;
}
