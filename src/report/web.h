#pragma once
// The page's script and style, built into the library by cmake/Embed.cmake.
#include <stddef.h>

extern const unsigned char clx_web_view_js[]; ///< web/dist/view.js
extern const size_t clx_web_view_js_size;
extern const unsigned char clx_web_page_css[]; ///< web/page.css
extern const size_t clx_web_page_css_size;
