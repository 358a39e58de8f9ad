// Help pages, from the same field tables that parse the options. The first page has 25 lines of 90
// columns at most (tests/cli/test_help.py).
#include "command.h"
#include "common_options.h"
#include "configs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 90, NAME_COLUMN = 23 };

void cli_field_name(const clast_field *f, char name[CLI_NAME_SIZE])
{
    const bool is_on = f->type == CLAST_FIELD_BOOL && f->value != 0.0;
    (void)snprintf(name, CLI_NAME_SIZE, "%s%s", is_on ? "[no-]" : "", f->name);
    for (char *c = name; *c != '\0'; ++c) {
        *c = *c == '_' ? '-' : *c;
    }
}

const char *cli_field_group(const clast_field *fields, const clast_field *f)
{
    return f->group == NULL && f == fields ? "options" : f->group;
}

/// A length as people say it: 104mm, 30um.
static const char *length_unit(double value, double *factor)
{
    static const struct {
        const char *name;
        double metre;
    } units[] = {{"m", 1.0}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
    int k = 0;
    while (k < 3 && fabs(value) < 0.999 * units[k].metre) {
        ++k;
    }
    *factor = units[k].metre;
    return units[k].name;
}

/// Whether a value is typed with this unit: m^d is the m^2 or m^3 of a bare number.
static bool is_typed(const char *unit)
{
    return strstr(unit, "m^d") == NULL;
}

/// A default as it is typed: 1deg, 104mm, 2650kg/m^3.
static void quantity_text(double value, const char *unit, char *text, size_t size)
{
    double factor = 1.0;
    const char *name = unit;
    if (strcmp(unit, "rad") == 0) {
        factor = CLAST_PI / 180.0;
        name = "deg";
    } else if (strcmp(unit, "m") == 0 && value != -1.0) {
        name = length_unit(value, &factor);
    } else if (strcmp(unit, "-") == 0 || value == -1.0 || !is_typed(unit)) {
        name = "";
    }
    // "11/s" would be eleven: of a unit that begins with a digit the slash is typed alone (1/s)
    (void)snprintf(text, size, "%g%s", value / factor,
                   value == 0.0 ? "" : name + (strncmp(name, "1/", 2) == 0));
}

static void default_text(const clast_field *f, char *text, size_t size)
{
    const char *unit = f->unit != NULL ? f->unit : "-";
    const bool is_list = f->type == CLAST_FIELD_F64_LIST && f->text != NULL;
    text[0] = '\0';
    if (f->type == CLAST_FIELD_CHOICE) {
        const int32_t index = (int32_t)f->value;
        clast_field one = *f;
        one.offset = 0;
        (void)clast_field_format(&one, &index, 0, size, text);
    } else if (f->type == CLAST_FIELD_F64) {
        quantity_text(f->value, unit, text, size);
    } else if (is_list && f->text[0] != '\0' && strchr(f->text, ',') == NULL) {
        quantity_text(strtod(f->text, NULL), unit, text, size);
    } else if (f->type == CLAST_FIELD_BOOL) {
        (void)snprintf(text, size, "%s", f->value != 0.0 ? "on" : "");
    } else if (f->type <= CLAST_FIELD_U64) {
        (void)snprintf(text, size, "%.0f", f->value);
    } else {
        (void)snprintf(text, size, "%s", f->text != NULL ? f->text : "");
    }
}

/// How a value with a unit looks where no default shows it.
static const char *looks_like(const clast_field *f)
{
    static const char *const look[][2] = {{"m", "270um"},  {"rad", "50deg"},
                                          {"kg", "0.5kg"}, {"kg/m^3", "2650kg/m^3"},
                                          {"s", "0.5s"},   {"m/s", "1m/s"}};
    for (size_t k = 0; f->unit != NULL && k < sizeof look / sizeof look[0]; ++k) {
        if (strcmp(f->unit, look[k][0]) == 0) {
            return look[k][1];
        }
    }
    return f->unit != NULL && strcmp(f->unit, "-") != 0 &&
                   strcmp(f->unit, CLAST_UNIT_OUTPUT) != 0 && is_typed(f->unit)
               ? f->unit
               : "";
}

void cli_field_values(const clast_field *f, char words[CLI_WORDS_SIZE])
{
    char value[128];
    const char *choices = f->type == CLAST_FIELD_CHOICE ? f->text : "";
    default_text(f, value, sizeof value);
    const bool is_none = value[0] == '\0' || strcmp(value, "0") == 0;
    const char *look = is_none ? looks_like(f) : "";
    (void)snprintf(words, CLI_WORDS_SIZE, "%s%s%s%s%s%s%s%s%s%s", choices[0] != '\0' ? " {" : "",
                   choices, choices[0] != '\0' ? "}" : "", look[0] != '\0' ? " (as " : "", look,
                   look[0] != '\0' ? ")" : "",
                   f->type == CLAST_FIELD_TEXT_LIST || f->type == CLAST_FIELD_F64_LIST
                       ? " (may be repeated)"
                       : "",
                   is_none ? "" : " (default ", is_none ? "" : value, is_none ? "" : ")");
}

/// Words from column `at` on, broken before COLUMNS, the next lines indented to `indent`.
static void print_wrapped(const char *text, int at, int indent)
{
    while (*text != '\0') {
        const int n = (int)strcspn(text, " ");
        if (at > indent && at + 1 + n > COLUMNS) {
            (void)printf("\n%*s", indent, "");
            at = indent;
        } else if (at > indent) {
            (void)putchar(' ');
            ++at;
        }
        (void)printf("%.*s", n, text);
        at += n;
        text += n;
        text += strspn(text, " ");
    }
    (void)putchar('\n');
}

static void print_field(const clast_field *f)
{
    char name[CLI_NAME_SIZE];
    char values[CLI_WORDS_SIZE];
    char text[CLI_WORDS_SIZE + 1024];
    cli_field_name(f, name);
    cli_field_values(f, values);
    (void)snprintf(text, sizeof text, "%s%s", f->help, values);
    const int at = printf("  --%-*s ", NAME_COLUMN - 5, name);
    print_wrapped(text, at, at > NAME_COLUMN ? NAME_COLUMN + 1 : at);
}

static const char MORE[] = ", ..."; ///< a list that goes on

/// Length of the longest part of a help text that ends with a clause and has at most `most` bytes:
/// before a comma, colon or bracket that stands in no brackets; 0 when there is none. `is_part` of
/// a list behind a colon, whose other members are left out: MORE then has its place too.
static int whole_clauses(const char *text, int most, bool *is_part)
{
    int found = 0;
    int depth = 0;
    bool is_list = false;
    *is_part = false;
    for (int k = 0;; ++k) {
        const char next = text[k] != '\0' ? text[k + 1] : '\0';
        const bool is_last = text[k] == '\0' || (depth == 0 && text[k] == ';');
        const bool is_clause = depth == 0 && (((text[k] == ',' || text[k] == ':') && next == ' ') ||
                                              (text[k] == ' ' && next == '('));
        const bool cuts = is_list && !is_last;
        if ((is_last || is_clause) && k + (cuts ? (int)strlen(MORE) : 0) <= most) {
            found = k;
            *is_part = cuts;
        }
        if (is_last) {
            return found;
        }
        is_list = is_list || (is_clause && text[k] == ':');
        depth += text[k] == '(' || text[k] == '[' ? 1 : text[k] == ')' || text[k] == ']' ? -1 : 0;
    }
}

/// The same of a field of choices: all of it, or what stands before the colon that opens their
/// meanings; a part of those would read as the meaning of all.
static int before_meanings(const char *text, int most)
{
    bool is_part = false;
    const char *colon = strstr(text, ": ");
    const int n = whole_clauses(text, (int)strlen(text), &is_part);
    const int first = colon != NULL && colon - text < n ? (int)(colon - text) : n;
    return n <= most ? n : first <= most ? first : whole_clauses(text, most, &is_part);
}

/// One line: the help's first clauses and the values, as much of both as fits. The choices are
/// there always, their default where it fits.
static void print_short(const clast_field *f)
{
    const bool is_choice = f->type == CLAST_FIELD_CHOICE;
    char name[CLI_NAME_SIZE];
    char values[CLI_WORDS_SIZE];
    bool is_part = false;
    cli_field_name(f, name);
    cli_field_values(f, values);
    const int at = printf("  --%-*s ", NAME_COLUMN - 5, name);
    const int left = COLUMNS - at - (int)strlen(values);
    int n = is_choice ? before_meanings(f->help, left) : whole_clauses(f->help, left, &is_part);
    if (n == 0 && is_choice) {
        (void)snprintf(values, sizeof values, " {%s}", f->text);
        n = before_meanings(f->help, COLUMNS - at - (int)strlen(values));
    } else if (n == 0) {
        values[0] = '\0';
        n = whole_clauses(f->help, COLUMNS - at, &is_part);
    }
    (void)printf("%.*s%s%s\n", n > 0 ? n : (int)strlen(f->help), f->help, is_part ? MORE : "",
                 values);
}

static void print_usage(const cli_command *command)
{
    (void)printf("usage: clast %s%s%s%s [options]\n%s\n", command->name,
                 command->arguments[0] != '\0' ? " " : "", command->arguments,
                 command->fields != NULL ? " [CONFIG.yaml]" : "", command->summary);
    (void)printf("\nexamples:\n");
    for (int k = 0; k < 3 && command->example[k] != NULL; ++k) {
        (void)printf("  %s\n", command->example[k]);
    }
}

/// Those options of every command that most runs need, in one line.
static void print_first_common(const cli_command *command)
{
    const char *between = "  ";
    for (const cli_option *o = cli_options; o->name != NULL; ++o) {
        if (o->first != NULL && cli_option_is_of(o, command)) {
            const char letter[] = {o->letter, '\0'};
            const bool is_short = o->letter != '\0';
            (void)printf("%s%s%s%s%s: %s", between, is_short ? "-" : "--",
                         is_short ? letter : o->name, o->value != NULL ? " " : "",
                         o->value != NULL ? o->value : "", o->first);
            between = "; ";
        }
    }
    (void)putchar('\n');
}

void cli_help(const cli_command *command)
{
    bool is_any = false; // of a short table that marks none, all are shown
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        is_any = is_any || f->common;
    }
    print_usage(command);
    (void)printf("\noptions:\n");
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        if (f->common || !is_any) {
            print_short(f);
        }
    }
    print_first_common(command);
    (void)printf("more: clast %s --help-all; man clast\n", command->name);
}

/// What a YAML file may say, and how values are written.
static void print_config_words(const cli_command *command)
{
    char key[CLI_NAME_SIZE];
    cli_configs_key(command, key);
    (void)printf(
        "Every option but those of every command is a key of CONFIG.yaml with '_' for '-'; the\n"
        "command line wins.");
    if (key[0] != '\0' && clast_fields_find(command->fields, key) == NULL) {
        const int n = (int)strlen(key);
        const char *name = command->arguments + (command->arguments[0] == '[' ? 1 : 0);
        (void)printf(" %.*s is its key %s.", n, name, key);
    }
    (void)printf(
        "\nA switch is turned off by --no-NAME or --NAME=false, on by --NAME or --NAME=true. A "
        "length or\n"
        "an angle needs its unit (270um, 50deg; 0 needs none); other bare numbers are SI.\n");
}

static void print_common(const cli_command *command)
{
    (void)printf("\nof every command:\n");
    for (const cli_option *o = cli_options; o->name != NULL; ++o) {
        if (o->help != NULL && cli_option_is_of(o, command)) {
            char words[CLI_NAME_SIZE];
            cli_option_words(o, words);
            const int at = printf("  %-*s ", NAME_COLUMN - 1, words);
            print_wrapped(o->help, at, at);
        }
    }
}

void cli_help_all(const cli_command *command)
{
    print_usage(command);
    if (command->details != NULL) {
        (void)printf("\n%s\n", command->details);
    }
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        const char *group = cli_field_group(command->fields, f);
        if (group != NULL) {
            (void)printf("\n%s:\n", group);
        }
        print_field(f);
    }
    print_common(command);
    if (command->fields != NULL) {
        print_config_words(command);
    }
    (void)printf("\nexit codes: 0 done, 1 a check answered no, 2 usage, 3 bad input, 4 not enough "
                 "memory or\n"
                 "            disk, 5 did not converge, 129/130/143 stopped by\n"
                 "            SIGHUP/SIGINT/SIGTERM (and --time-limit), with a checkpoint where it "
                 "has one\n");
}
