// Formulas are shown as TeX: the site needs no network and bundles no renderer.
