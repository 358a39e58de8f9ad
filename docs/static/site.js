// A box that scrolls sideways can be reached and scrolled by the keyboard; one that fits is no stop of the Tab key.
(function () {
    const BOXES = "article pre, .table-wrapper, .formula, article dt.sig, article .katex";
    const ROLES = {PRE: "region", DIV: "region"};

    function markBoxes() {
        for (const box of document.querySelectorAll(BOXES)) {
            const scrolls = box.scrollWidth > box.clientWidth + 1 && ["auto", "scroll"].includes(getComputedStyle(box).overflowX);
            if (!scrolls) {
                box.removeAttribute("tabindex");
                continue;
            }
            box.tabIndex = 0;
            if (ROLES[box.tagName] && !box.hasAttribute("role")) {
                box.setAttribute("role", ROLES[box.tagName]);
                box.setAttribute("aria-label", box.tagName === "PRE" ? "code, scrolls sideways" : "table, scrolls sideways");
            }
        }
    }

    let waits = 0;
    addEventListener("resize", () => { clearTimeout(waits); waits = setTimeout(markBoxes, 150); });
    addEventListener("load", markBoxes);
    addEventListener("change", event => { if (event.target.matches(".tab-set > input")) markBoxes(); });
}());
