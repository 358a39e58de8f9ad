#pragma once
#include <clast/status.h>

CLAST_BEGIN

// One table per configuration feeds the defaults, the range check, --help, the YAML file, the
// command line and the manifest. Nothing else knows a default.

typedef enum {
    CLAST_FIELD_F64,       ///< double
    CLAST_FIELD_I32,       ///< int32_t
    CLAST_FIELD_I64,       ///< int64_t
    CLAST_FIELD_U64,       ///< uint64_t
    CLAST_FIELD_BOOL,      ///< bool
    CLAST_FIELD_CHOICE,    ///< int32_t index into the words of `text`, "exact|spheres|march"
    CLAST_FIELD_TEXT,      ///< char *, owned, never NULL after default; `text` is the default
    CLAST_FIELD_TEXT_LIST, ///< clast_text_list
    CLAST_FIELD_F64_LIST   ///< clast_f64_list
} clast_field_type;

typedef struct clast_text_list {
    int32_t n;
    char **item; ///< [n] owned
} clast_text_list;

typedef struct clast_f64_list {
    int32_t n;
    double *item; ///< [n] owned
} clast_f64_list;

/// Unit of a text that names a file or a folder to write.
#define CLAST_UNIT_OUTPUT "output"

/// Text of a number whose bare values are SI also where it is a length or an angle: options that
/// had no unit once.
#define CLAST_BARE_SI "SI"

/// Text of a number whose unit is m^d or m^d/s, d the dimension of the points: it takes m, m^2, m^3
/// and their like, by a time or not, and the int32_t behind it in the struct keeps their d, 0 of a
/// bare number.
#define CLAST_KEEPS_DIMENSION "m^d"

/// One field; a table of them ends with {0}. The members stand in the order that tables give them
/// in.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding)
typedef struct clast_field {
    const char *name; ///< key in files; the option is --name with '-' for '_'
    size_t offset;    ///< in the configuration struct
    clast_field_type type;
    double value;      ///< default of a number, bool or choice
    double low, high;  ///< range of a number, both included
    const char *unit;  ///< SI unit of the stored number, "-" for none; inputs may carry any unit of
                       ///< that dimension
    const char *help;  ///< one line
    const char *text;  ///< choices "a|b|c", the default text, default list "a,b", CLAST_BARE_SI or
                       ///< CLAST_KEEPS_DIMENSION
    const char *group; ///< heading of this field and of those after it, up to the next heading
    bool common;       ///< most runs need it: --help shows it, --help-all shows every field
} clast_field;

/// Sets every field to its default. The struct's bytes before are ignored (not freed).
CLAST_API clast_status clast_fields_default(const clast_field *fields, void *config);

/// Frees owned texts and lists.
CLAST_API void clast_fields_free(const clast_field *fields, void *config);

/// Whether each field holds what the table allows: numbers finite and in their range, choices of
/// the list, texts and lists not NULL. Every function that takes a configuration begins with it.
///
/// @return CLAST_E_CONFIG names the field, its value and the range
CLAST_API clast_status clast_fields_check(const clast_field *fields, const void *config);

/// The named field ('-' and '_' alike), or NULL.
CLAST_API const clast_field *clast_fields_find(const clast_field *fields, const char *name);

/// Known name nearest to a misspelt one (edit distance), or NULL when nothing is near.
CLAST_API const char *clast_fields_nearest(const clast_field *fields, const char *name);

/// Parses a text ("675 um", "50deg", "true", "exact") into a field. Lists: replaces by one item, or
/// appends. A bare length or angle is refused (`270um`, never `270`), but for 0 and for a -1 that
/// stands for "none" and for CLAST_BARE_SI; any other bare number is SI. Whole numbers are decimal
/// (010 is 10), hexadecimal after 0x, or 1e6.
/// @return CLAST_E_CONFIG with the key, the text, the range and the unit in the message
CLAST_API clast_status clast_field_set(const clast_field *field, void *config, const char *text,
                                       bool append);

/// The same of what clast_field_format and clast_fields_json write: every bare number is SI.
CLAST_API clast_status clast_field_set_si(const clast_field *field, void *config, const char *text,
                                          bool append);

/// Empties a list field.
CLAST_API void clast_field_clear(const clast_field *field, void *config);

/// Value as text, as clast_field_set_si reads it (17 digits, SI, no unit). Lists: item `index`.
///
/// @return its length as snprintf counts it; -1 for an item that there is not, a text that is NULL
/// or a choice outside of the list, `text` then being untouched
CLAST_API int clast_field_format(const clast_field *field, const void *config, int32_t index,
                                 size_t size, char *text);

/// Number of items: lists their length, all others 1.
CLAST_API int32_t clast_field_count(const clast_field *field, const void *config);

/// Whether the field has its default.
CLAST_API bool clast_field_is_default(const clast_field *field, const void *config);

/// Fields that a run would not look at; a list of these ends with {0}. A function of each
/// configuration writes its own (clast_fill_idle): bindings and programs ask it what a person gave
/// for nothing.
struct clast_idle {
    bool is_idle;
    const char *names; ///< "size_mean|size_low"
    const char *why;   ///< "without size_law", or with options as they are typed, "with --overlap"
};

enum { CLAST_N_IDLE = 16 }; ///< rows of such a list with its {0}

/// The first field that is idle by a rule and has another value than its default: a
/// parameter without effect is a mistake of the person who gives it.
///
/// @param why  of that rule; unchanged where there is none
/// @return NULL where there is none, or where a pointer is NULL
CLAST_API const clast_field *clast_fields_idle(const clast_field *fields, const void *config,
                                               const clast_idle *rules, const char **why);

/// Parses a number with an optional unit of the given dimension ("2.8 mm" for "m"); plain numbers
/// are SI. Spaces between number and unit are optional. "phi" is accepted for lengths: 2^-phi mm.
CLAST_API clast_status clast_unit_parse(const char *text, const char *si_unit, double *value);

/// The same where a unit is asked for: a bare length or angle other than 0 is refused, with its
/// nearest correct spelling ("270um", "50deg").
CLAST_API clast_status clast_unit_parse_asked(const char *text, const char *si_unit, double *value);

/// A length as typed, in a file's `own` unit ("mm"; "" or "model": it names none): one with a unit
/// is converted, or refused where the file names none; a bare number is in the file's own, but for
/// metres, of which it is refused as by clast_unit_parse_asked.
///
/// @return CLAST_E_CONFIG, for % too
CLAST_API clast_status clast_unit_parse_length(const char *text, const char *own, double *value);

/// Factor that turns one `unit` into SI `si_unit`; CLAST_E_CONFIG lists the known units.
CLAST_API clast_status clast_unit_factor(const char *unit, const char *si_unit, double *factor);

/// The unit in which a person would write `value` of this SI unit: "um" of 3.75e-6 m.
///
/// @param factor  how many of it are one SI unit, 1e6; 1 where people use no other
/// @return its name, or `si_unit`; "" where either pointer is NULL
CLAST_API const char *clast_unit_for(double value, const char *si_unit, double *factor);

/// Reads a YAML mapping of keys to scalars or lists of scalars over `config` (already defaulted).
///
/// Scalars are texts, typed by the field table (YAML 1.1 has no say). Lists replace the field's
/// list. A bare length or angle is refused, as by clast_field_set.
/// @return CLAST_E_CONFIG for an unknown key (with file, line and the nearest known key), a value
/// out of range, a duplicate key or nested mapping: keys before it, and items of a list, are then
/// set, what follows is not; CLAST_E_IO if unreadable; files over 16 MiB are refused
CLAST_API clast_status clast_fields_read(const char *path, const clast_field *fields, void *config);

/// The same from a text, YAML or JSON (what clast_fields_json writes: every bare number is SI);
/// `name` stands for the path. What fails leaves the keys before it set, too.
CLAST_API clast_status clast_fields_parse(const char *name, const char *text,
                                          const clast_field *fields, void *config);

CLAST_END
