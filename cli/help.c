// Help pages, from the same field tables that parse the options.
#include "command.h"

#include <stdio.h>
#include <string.h>

static void default_text(const clast_field *f, char *text, size_t size)
{
    switch (f->type) {
    case CLAST_FIELD_F64:
        (void)snprintf(text, size, "%g", f->value);
        break;
    case CLAST_FIELD_I32:
    case CLAST_FIELD_I64:
    case CLAST_FIELD_U64:
        (void)snprintf(text, size, "%.0f", f->value);
        break;
    case CLAST_FIELD_BOOL:
        (void)snprintf(text, size, "%s", f->value != 0.0 ? "true" : "false");
        break;
    case CLAST_FIELD_CHOICE: {
        const int32_t index = (int32_t)f->value;
        clast_field one = *f;
        one.offset = 0;
        if (clast_field_format(&one, &index, 0, text, size) < 0) {
            text[0] = '\0';
        }
        break;
    }
    default:
        (void)snprintf(text, size, "%s", f->text != NULL ? f->text : "");
    }
}

static void print_field(const clast_field *f)
{
    char name[64];
    char value[128];
    const bool is_on = f->type == CLAST_FIELD_BOOL && f->value != 0.0;
    (void)snprintf(name, sizeof name, "%s%s", is_on ? "[no-]" : "", f->name);
    for (char *c = name; *c != '\0'; ++c) {
        *c = *c == '_' ? '-' : *c;
    }
    default_text(f, value, sizeof value);
    (void)printf("  --%-20s %s", name, f->help);
    if (f->type == CLAST_FIELD_CHOICE) {
        (void)printf(" {%s}", f->text);
    }
    if (f->unit != NULL && f->unit[0] != '\0' && strcmp(f->unit, "-") != 0) {
        (void)printf(" [%s]", f->unit);
    }
    if (f->type == CLAST_FIELD_TEXT_LIST || f->type == CLAST_FIELD_F64_LIST) {
        (void)printf(" (may be repeated)");
    }
    if (value[0] != '\0') {
        (void)printf(" (default %s)", value);
    }
    (void)putchar('\n');
}

void cli_help(const cli_command *command)
{
    (void)printf("usage: clast %s%s%s%s [options]\n\n%s\n", command->name,
                 command->arguments[0] != '\0' ? " " : "", command->arguments,
                 command->takes_config ? " [CONFIG.yaml]" : "", command->summary);
    if (command->details != NULL) {
        (void)printf("\n%s\n", command->details);
    }
    if (command->fields != NULL) {
        (void)printf("\noptions (every one is also a key of the YAML file, with '_' for '-'):\n");
        for (const clast_field *f = command->fields; f->name != NULL; ++f) {
            print_field(f);
        }
    }
    (void)printf(
        "\ncommon options:\n"
        "  -o, --output PATH      where results go\n"
        "  -j, --threads N        threads; 0 means one per core; results do not depend on it\n"
        "  --set KEY=VALUE        the same as --KEY VALUE\n"
        "  --json                 one JSON object on stdout\n"
        "  -q, --quiet            no progress on stderr\n"
        "  -h, --help             this page\n"
        "a switch is turned off by --no-NAME or --NAME=false, on by --NAME or --NAME=true\n\n"
        "exit codes: 0 done, 1 a check answered no, 2 usage, 3 bad input, 4 not enough memory or "
        "disk,\n"
        "            5 did not converge, 130/143 stopped with a checkpoint\n");
}
