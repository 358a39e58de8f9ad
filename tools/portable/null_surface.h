#pragma once
// A surface on which nothing is drawn, by functions of the types that cairo's table of a backend
// has. Included into cairo-analysis-surface.c alone.

static cairo_int_status_t null_paint(void *surface, cairo_operator_t op,
                                     const cairo_pattern_t *source, const cairo_clip_t *clip)
{
    return CAIRO_INT_STATUS_SUCCESS;
}

static cairo_int_status_t null_mask(void *surface, cairo_operator_t op,
                                    const cairo_pattern_t *source, const cairo_pattern_t *mask,
                                    const cairo_clip_t *clip)
{
    return CAIRO_INT_STATUS_SUCCESS;
}

static cairo_int_status_t null_stroke(void *surface, cairo_operator_t op,
                                      const cairo_pattern_t *source, const cairo_path_fixed_t *path,
                                      const cairo_stroke_style_t *style, const cairo_matrix_t *ctm,
                                      const cairo_matrix_t *ctm_inverse, double tolerance,
                                      cairo_antialias_t antialias, const cairo_clip_t *clip)
{
    return CAIRO_INT_STATUS_SUCCESS;
}

static cairo_int_status_t null_fill(void *surface, cairo_operator_t op,
                                    const cairo_pattern_t *source, const cairo_path_fixed_t *path,
                                    cairo_fill_rule_t fill_rule, double tolerance,
                                    cairo_antialias_t antialias, const cairo_clip_t *clip)
{
    return CAIRO_INT_STATUS_SUCCESS;
}

static cairo_int_status_t null_show_glyphs(void *surface, cairo_operator_t op,
                                           const cairo_pattern_t *source, cairo_glyph_t *glyphs,
                                           int n_glyph, cairo_scaled_font_t *font,
                                           const cairo_clip_t *clip)
{
    return CAIRO_INT_STATUS_SUCCESS;
}
