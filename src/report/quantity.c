// Units and digits of the report's numbers.
#include "report/quantity.h"

#include "base/file.h"
#include "base/number.h"
#include "report/page.h"
#include <clast/field.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// Unit as a page shows it, where there is but one of its kind: "kg/m^3" -> "kg/m³", "-" -> "".
static const char *plain_unit(const char *si_unit)
{
    static const char *const units[][2] = {{"-", ""},
                                           {"kg/m^3", "kg/m\302\263"},
                                           {"m/s^2", "m/s\302\262"},
                                           {"J/m^2", "J/m\302\262"},
                                           {"J/m^3", "J/m\302\263"},
                                           {"model units^2", "model units\302\262"},
                                           {"model units^3", "model units\302\263"},
                                           {"1/m^2", "1/m\302\262"},
                                           {"1/m^3", "1/m\302\263"},
                                           {"m^2", "m\302\262"},
                                           {"mm^2", "mm\302\262"},
                                           {"um^2", "\302\265m\302\262"},
                                           {"nm^2", "nm\302\262"},
                                           {"m^3", "m\302\263"},
                                           {"cm^3", "cm\302\263"},
                                           {"mm^3", "mm\302\263"},
                                           {"um^3", "\302\265m\302\263"},
                                           {"nm^3", "nm\302\263"},
                                           {"deg", "\302\260"},
                                           {"um", "\302\265m"},
                                           {"ug", "\302\265g"},
                                           {"us", "\302\265s"},
                                           {"um/s", "\302\265m/s"},
                                           {"uJ", "\302\265J"},
                                           {"uN", "\302\265N"},
                                           {"uPa s", "\302\265Pa s"}};
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k) {
        if (strcmp(units[k][0], si_unit) == 0) {
            return units[k][1];
        }
    }
    return si_unit;
}

const char *clx_quantity_model_unit(const char *si_unit)
{
    static const char *const units[][2] = {{"m", "model units"},
                                           {"m^2", "model units^2"},
                                           {"m^3", "model units^3"},
                                           {"1/m", "1/model unit"}};
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k) {
        if (strcmp(units[k][0], si_unit) == 0) {
            return units[k][1];
        }
    }
    return si_unit;
}

clx_quantity_scale clx_quantity_scale_for(double value, const char *si_unit)
{
    double factor = 1.0;
    const char *name = clast_unit_for(value, si_unit, &factor);
    return (clx_quantity_scale){factor, plain_unit(name), strcmp(si_unit, "m") == 0};
}

/// -12 as superscript digits.
static void raise_digits(int power, char out[32])
{
    static const char *const digit[] = {
        "\342\201\260", "\302\271",     "\302\262",     "\302\263",     "\342\201\264",
        "\342\201\265", "\342\201\266", "\342\201\267", "\342\201\270", "\342\201\271"};
    char plain[16];
    out[0] = '\0';
    (void)snprintf(plain, sizeof plain, "%d", power);
    for (const char *c = plain; *c != '\0'; ++c) {
        const size_t used = strlen(out);
        (void)snprintf(out + used, 32 - used, "%s", *c == '-' ? "\342\201\273" : digit[*c - '0']);
    }
}

void clx_quantity_format(double value, const clx_quantity_scale *scale,
                         char text[CLX_QUANTITY_SIZE])
{
    const double shown = value * scale->factor;
    const double size = fabs(shown);
    const bool is_count = shown == floor(shown) && size < 1e9;
    if (is_count && (scale->name[0] == '\0' || shown == 0.0)) {
        (void)clx_number_print(text, CLX_QUANTITY_SIZE, "%.0f", shown);
    } else if (scale->has_floor && size < 1e-3) {
        (void)snprintf(text, CLX_QUANTITY_SIZE, "%s0.001", shown < 0.0 ? "> \342\210\222" : "< ");
    } else if (size >= 1e-3 && size < 1e6) {
        const int digits = 3 - (int)floor(log10(size));
        (void)clx_number_print(text, CLX_QUANTITY_SIZE, "%.*f", digits > 0 ? digits : 0, shown);
    } else {
        const int power = (int)floor(log10(size) + 1e-12);
        char superscript[32];
        raise_digits(power, superscript);
        (void)clx_number_print(text, CLX_QUANTITY_SIZE, "%.3f\302\240\303\227\302\24010%s",
                               shown / pow(10.0, power), superscript);
    }
}

void clx_quantity_put(clx_file *file, double value, const char *si_unit)
{
    clx_quantity_put_like(file, value, si_unit, value);
}

void clx_quantity_put_like(clx_file *file, double value, const char *si_unit, double like)
{
    char text[CLX_QUANTITY_SIZE];
    if (!isfinite(value)) {
        (void)clx_file_print(file, "<span title=\"%s\">\342\200\223</span>",
                             isnan(value) ? "not known" : "infinite");
        return;
    }
    clx_quantity_scale scale = clx_quantity_scale_for(like, si_unit);
    if (scale.has_floor && value != like) { // what is below the floor is told in its own unit
        const clx_quantity_scale own = clx_quantity_scale_for(value, si_unit);
        scale.has_floor = false;
        scale = value != 0.0 && fabs(value) * own.factor < 1e-3 ? own : scale;
    }
    clx_quantity_format(value, &scale, text);
    (void)clx_file_print(file, "<span title=\"%.17g ", value);
    clx_page_text(file, plain_unit(si_unit));
    (void)clx_file_print(file, "\">");
    clx_page_text(file, text);
    if (scale.name[0] != '\0') {
        const bool is_degree = strcmp(scale.name, "\302\260") == 0;
        (void)clx_file_print(file, "%s<span class=\"unit\">", is_degree ? "" : "\302\240");
        clx_page_text(file, scale.name);
        (void)clx_file_print(file, "</span>");
    }
    (void)clx_file_print(file, "</span>");
}

void clx_quantity_put_word(clx_file *file, double value, const char *words)
{
    const char *at = words;
    for (int k = 0; k < 16 && at != NULL && *at != '\0'; ++k) {
        const char *bar = strchr(at, '|');
        if (value == k) {
            const int n = bar != NULL ? (int)(bar - at) : (int)strlen(at);
            (void)clx_file_print(file, "%.*s", n, at);
            return;
        }
        at = bar != NULL ? bar + 1 : NULL;
    }
    clx_quantity_put(file, value, "");
}
