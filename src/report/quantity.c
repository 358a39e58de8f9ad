// Units and digits of the report's numbers.
#include "report/quantity.h"

#include "base/file.h"
#include "base/number.h"
#include "report/page.h"
#include <clast/field.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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

void clx_quantity_show_unit(const char *si_unit, char out[CLX_UNIT_SIZE])
{
    const bool is_micro = si_unit[0] == 'u' && strspn(si_unit + 1, "mgsJNP") > 0;
    const char *at = strcmp(si_unit, "-") == 0 ? "" : si_unit;
    if (strcmp(si_unit, "deg") == 0) {
        at = "\302\260";
    }
    size_t n = (size_t)snprintf(out, CLX_UNIT_SIZE, "%s", is_micro ? "\302\265" : "");
    at += is_micro ? 1 : 0;
    while (*at != '\0' && n + 8 < CLX_UNIT_SIZE) {
        char raised[32] = "";
        if (at[0] == '^' && isdigit((unsigned char)at[1])) {
            raise_digits(at[1] - '0', raised);
        }
        const bool is_raised = raised[0] != '\0';
        n += (size_t)snprintf(out + n, CLX_UNIT_SIZE - n, "%.*s", is_raised ? 32 : 1,
                              is_raised ? raised : at);
        at += is_raised ? 2 : 1;
    }
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
    clx_quantity_scale scale = {.factor = factor, .has_floor = strcmp(si_unit, "m") == 0};
    clx_quantity_show_unit(name, scale.name);
    return scale;
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

void clx_quantity_write(clx_file *file, double value, const char *si_unit)
{
    clx_quantity_write_like(file, value, si_unit, value);
}

void clx_quantity_write_like(clx_file *file, double value, const char *si_unit, double like)
{
    char text[CLX_QUANTITY_SIZE];
    char unit[CLX_UNIT_SIZE];
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
    clx_quantity_show_unit(si_unit, unit);
    (void)clx_file_print(file, "<span title=\"%.17g ", value);
    clx_page_text(file, unit);
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

void clx_quantity_write_word(clx_file *file, double value, const char *words)
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
    clx_quantity_write(file, value, "");
}
