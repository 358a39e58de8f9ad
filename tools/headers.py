"""Reads the public headers: structs, enums, functions, field tables and the documentation above and behind each."""
import pathlib
import re

HEAP = {"clast_text_free", "clast_chart_bytes_free", "clast_voxels_labels_free"}  # free what they are given


def split(text, at=","):
    parts, depth, part = [], 0, ""
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        if c == at and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    return parts + [part.strip()] if part.strip() else parts


class Declared:
    """One member or argument: name, element type, stars and array bounds before the element."""

    def __init__(self, text):
        text = " ".join(text.split())
        self.is_function = re.search(r"\(\*\s*\w*\)\s*\(", text) is not None
        inner = re.search(r"\(\s*\*\s*(?:const\s*)?(\w+)\s*\)", text)
        self.dims = re.findall(r"\[([^\]]*)\]", text)
        bare = re.sub(r"\[[^\]]*\]", "", text)
        self.name = inner.group(1) if inner else re.findall(r"\w+", bare)[-1]
        self.stars = text.count("*")
        head = bare[:bare.rindex(self.name)]
        self.is_const = head.strip().startswith("const ")
        self.type = " ".join(w for w in re.findall(r"\w+", head) if w not in ("const", "struct"))
        self.is_row = inner is not None  # pointer to arrays
        self.text = text


def members(body):
    for line in split(body, ";"):
        parts = split(line)
        yield Declared(parts[0])
        for more in parts[1:]:
            yield Declared(re.match(r"(?:const )?(?:unsigned )?\w+", parts[0]).group(0) + " " + more)


class Headers:
    def __init__(self, folder):
        text = "\n".join(p.read_text() for p in sorted(pathlib.Path(folder).glob("clast/*.h")) if p.name not in ("mpi.h",))
        self.raw = text
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
        self.enums = set(re.findall(r"typedef enum\s*\w*\s*\{[^}]*\}\s*(clast_\w+);", text))
        self.structs = {}
        for name, body in re.findall(r"^(?:typedef )?struct (clast_\w+) \{(.*?)^\}(?: clast_\w+)?;", text, flags=re.S | re.M):
            self.structs[name] = list(members(body))
        self.opaque = set(re.findall(r"typedef struct (clast_\w+) clast_\w+;", text)) - set(self.structs)
        self.functions = []
        for result, name, arguments in re.findall(r"CLAST_API\s+([^;{()]*?)\b(clast_\w+)\s*\(([^;]*?)\)\s*;", text, flags=re.S):
            arguments = [] if arguments.strip() == "void" else [Declared(a) for a in split(arguments)]
            self.functions.append((" ".join(result.split()), name, arguments))
        self.free = {a[0].type: name for result, name, a in self.functions
                     if re.search(r"_(free|unload)$", name) and len(a) == 1 and a[0].type in self.structs and name not in HEAP}
        self.destroy = {a[0].type: name for result, name, a in self.functions if name.endswith("_destroy")}

    def doc(self, pattern):
        """The /// lines above the first declaration that matches, or the ///< behind it, as one text."""
        found = re.search(r"((?:^///[^\n]*\n)*)^" + pattern + r"[^;{\n]*(?:[;{][^\S\n]*///<([^\n]*))?", self.raw, flags=re.M)
        if found is None:
            return ""
        above = " ".join(line[3:].strip() for line in found.group(1).splitlines())
        return " ".join((above or found.group(2) or "").split())

    def member_docs(self, name):
        """{member: text of its ///<} of a struct."""
        body = re.search(r"^(?:typedef )?struct " + name + r" \{(.*?)^\}(?: " + name + ")?;", self.raw, flags=re.S | re.M)
        docs, names = {}, []
        for line in body.group(1).splitlines() if body else []:
            code, mark, text = line.partition("///<")
            code = re.sub(r"//.*", "", code)
            if code.strip():
                names = [d.name for d in members(code)] if ";" in code else []
            for one in names if mark else []:
                docs[one] = (docs.get(one, "") + " " + text.strip()).strip()
        return docs

    def enumerators(self):
        """[(type or "", name)] of every enumerator, in the headers' order."""
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", self.raw, flags=re.S)
        for body, name in re.findall(r"\benum\s*\w*\s*\{([^}]*)\}\s*(\w*)\s*;", text):
            for part in split(re.sub(r"(\w+_LIST\(\w+\))\s*(?=\w)", r"\1, ", body)):
                made = re.match(r"(\w+_LIST)\((\w+)\)", part)
                yield from ((name, one) for one in self.listed(*made.groups())) if made else [(name, re.match(r"\w+", part).group(0))]

    def listed(self, name, maker):
        """Enumerators that a list of X(...) gives through #define maker(name, ...) PREFIX_##name."""
        text = re.sub(r"\\\n\s*", " ", self.raw)
        before = re.search(r"#define " + maker + r"\([^\n]*?\b(\w+_)##", text).group(1)
        rows = re.search(r"#define " + name + r"\(X\)([^\n]*)", text).group(1)
        return [before + row for row in re.findall(r"\bX\((\w+)", rows)]

    def tables(self):
        """Names of the public field tables."""
        return re.findall(r"(?:extern CLAST_API|CLAST_API extern) const clast_field (\w+)\[\];", self.raw)
