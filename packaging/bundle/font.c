// The font of charts and pictures, carried along: a machine without fonts has only cairo's own,
// which lacks "µ". The linker sends clast's calls of cairo_select_font_face here (--wrap); the
// family that clast names, DejaVu Sans, is the one that is carried.
#include <cairo-ft.h>
#include <pthread.h>

#ifndef CARRIED_PATH // cmake/Bundle.cmake names the folder where it found them
#define CARRIED_PATH "/usr/share/fonts/truetype/dejavu"
#endif
#define HIDDEN __attribute__((visibility("hidden")))

__asm__(".section .rodata\n"
        ".balign 16\n"
        "carried_sans: .incbin \"" CARRIED_PATH "/DejaVuSans.ttf\"\n"
        "carried_sans_end: .byte 0\n"
        ".balign 16\n"
        "carried_bold: .incbin \"" CARRIED_PATH "/DejaVuSans-Bold.ttf\"\n"
        "carried_bold_end: .byte 0\n"
        ".previous\n");
extern HIDDEN const unsigned char carried_sans[], carried_sans_end[];
extern HIDDEN const unsigned char carried_bold[], carried_bold_end[];

/// Made once for the process, which keeps them: cairo's cache of glyphs looks into them until its
/// end. NULL: FreeType refused.
static cairo_font_face_t *sans, *bold;
static pthread_once_t is_made = PTHREAD_ONCE_INIT;

static cairo_font_face_t *make_face(FT_Library library, const unsigned char *from,
                                    const unsigned char *to)
{
    FT_Face face = NULL;
    return FT_New_Memory_Face(library, from, (FT_Long)(to - from), 0, &face) == 0
               ? cairo_ft_font_face_create_for_ft_face(face, 0)
               : NULL;
}

static void make_faces(void)
{
    FT_Library library = NULL;
    if (FT_Init_FreeType(&library) == 0) {
        sans = make_face(library, carried_sans, carried_sans_end);
        bold = make_face(library, carried_bold, carried_bold_end);
    }
}

// The linker makes these two names.
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void __real_cairo_select_font_face(cairo_t *cr, const char *family, cairo_font_slant_t slant,
                                   cairo_font_weight_t weight);
void __wrap_cairo_select_font_face(cairo_t *cr, const char *family, cairo_font_slant_t slant,
                                   cairo_font_weight_t weight);
void __wrap_cairo_select_font_face(cairo_t *cr, const char *family, cairo_font_slant_t slant,
                                   cairo_font_weight_t weight)
{
    (void)pthread_once(&is_made, make_faces);
    cairo_font_face_t *face = weight == CAIRO_FONT_WEIGHT_BOLD ? bold : sans;
    if (face != NULL) {
        cairo_set_font_face(cr, face);
    } else {
        __real_cairo_select_font_face(cr, family, slant, weight);
    }
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
