() => {
    // What tools/check_site.py asks of each page: faults (one line each) and the links it holds.
    const faults = [], say = text => faults.push(text.replace(/\s+/g, " ").slice(0, 220));
    const shown = e => e.checkVisibility ? e.checkVisibility({visibilityProperty: true}) : e.offsetParent !== null;
    const name = e => [e.getAttribute("aria-label"), e.getAttribute("title"), e.textContent, e.querySelector?.("img[alt]")?.alt]
        .some(words => words?.trim());
    const html = e => e.outerHTML.slice(0, 120);

    // Formulas: no TeX in what is read (\xNN is how a byte is shown).
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
        if (node.parentElement.closest("pre, code, script, style, annotation")) continue;
        const raw = node.nodeValue.match(/\\(?!xNN|x[0-9A-Fa-f]{2}\b)[a-zA-Z]{2,}|\$[^$\n]{1,80}\$|\\[()[\]]|\$\$|\b[A-Za-z]_\{|\^\{/);
        if (raw) say(`TeX left in text: ${raw[0]} in "${node.nodeValue.slice(0, 80)}"`);
    }
    for (const e of document.querySelectorAll(".katex-error, .problematic, .system-message")) say(`not set: ${e.textContent}`);

    // Width, pictures.
    const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
    if (wide > 0) {
        const by = [...document.querySelectorAll("article *")].filter(e => e.getBoundingClientRect().right > innerWidth + 1 &&
            !e.parentElement.closest(".formula, pre, .table-wrapper, .highlight, dt.sig")).slice(-1)[0];
        say(`wider than the screen by ${wide} px: ${by ? html(by) : ""}`);
    }
    for (const e of document.images) if (e.complete && !e.naturalWidth) say(`picture does not load: ${e.getAttribute("src")}`);

    // Names, language, headings, ids.
    if (!document.documentElement.lang) say("html has no lang");
    if (!document.title.trim()) say("no title");
    const heads = [...document.querySelectorAll("h1, h2, h3, h4, h5, h6")].filter(shown);
    if (heads.filter(h => h.tagName === "H1").length !== 1) say(`${heads.filter(h => h.tagName === "H1").length} h1`);
    heads.reduce((last, h) => {
        if (+h.tagName[1] > last + 1) say(`heading of level ${h.tagName[1]} after ${last}: ${h.textContent}`);
        return +h.tagName[1];
    }, 1);
    for (const e of document.querySelectorAll("img:not([alt]), img[alt='']")) say(`picture without words: ${html(e)}`);
    for (const e of document.querySelectorAll("article img[alt]")) if (/\.(png|svg|jpe?g)$/.test(e.alt)) say(`picture whose words are its file: ${e.alt}`);
    for (const e of document.querySelectorAll("a[href], button")) if (shown(e) && !name(e)) say(`link or button without a name: ${html(e)}`);
    for (const e of document.querySelectorAll("input:not([type=hidden]), select, textarea")) {
        if (!e.labels?.length && !e.getAttribute("aria-label") && !e.title) say(`field without a label: ${html(e)}`);
    }
    const ids = new Set();
    for (const e of document.querySelectorAll("[id]")) { if (ids.has(e.id)) say(`id twice: ${e.id}`); ids.add(e.id); }

    // Contrast of text on the nearest background that is not transparent.
    const numbers = colour => colour.match(/[\d.]+/g).map(Number);
    const light = ([r, g, b]) => [r, g, b].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
    const behind = e => {
        for (; e; e = e.parentElement) {
            const c = numbers(getComputedStyle(e).backgroundColor);
            if (c.length < 4 || c[3] === 1) return c;
        }
        return [255, 255, 255];
    };
    const told = new Set();
    for (const e of document.querySelectorAll("article *, .sidebar-drawer *, .toc-drawer *, footer *")) {
        if (![...e.childNodes].some(n => n.nodeType === 3 && n.nodeValue.trim()) || e.closest("svg, .headerlink, .visually-hidden") || !shown(e)) continue;
        const style = getComputedStyle(e), text = numbers(style.color);
        if (text.length === 4 && text[3] < 1 || +style.opacity < 1) continue;
        const [a, b] = [light(text), light(behind(e))], ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        const size = parseFloat(style.fontSize), large = size >= 24 || size >= 18.66 && +style.fontWeight >= 700;
        const key = `${style.color} ${e.className}`;
        if (ratio < (large ? 3 : 4.5) - 0.01 && !told.has(key)) { told.add(key); say(`contrast ${ratio.toFixed(2)}: ${html(e)}`); }
    }
    return {faults, links: [...document.querySelectorAll("a[href]")].map(a => a.href)};
}
