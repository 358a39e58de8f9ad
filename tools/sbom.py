#!/usr/bin/env python3
"""What a bundled clast holds of others, as SPDX 2.3, with the licence texts: tools/sbom.py FOLDER FILE... --map MAP... [--carried FILE...]

MAP... are the linker's, which tell what archives it took; packaging/bundle/bundled.txt tells the licence of each and is the list of all that may be
taken; dpkg tells package, version and licence text. FOLDER gets sbom.spdx.json, LICENSE and licences/. FILE... are the linked files, named
from the current folder; --carried: shared objects that lie beside them. The same input gives the same bytes.
"""
import argparse
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMON = pathlib.Path("/usr/share/common-licenses")


def fail(line):
    sys.exit(f"sbom: {line}")


def dpkg(*words):
    try:
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError) as why:
        fail(f"{' '.join(words)}: {getattr(why, 'stderr', '') or why} (the list is made of dpkg's data, on Debian)")


def table():
    """Name -> (in its place in a shared library, licence)."""
    lines = (ROOT / "packaging/bundle/bundled.txt").read_text().splitlines()
    rows = [line.split(None, 2) for line in lines if line and not line.startswith("#")]
    return {row[0]: (row[1], row[2]) for row in rows}


def archives(maps):
    """The archives of which the linker took members."""
    found = set()
    for link_map in maps:
        taken = pathlib.Path(link_map).read_text(errors="replace").split("\nDiscarded input sections", 1)[0]
        here = {os.path.normpath(path) for path in re.findall(r"^(/\S+\.a)\(", taken, re.M)}
        found |= here or fail(f"{link_map} names no archive")
    return sorted(found)


def licence_of(path, rows):
    for name, (_, licence) in rows.items():
        if path.endswith("/" + name):
            return licence
    fail(f"{path} was linked, and is not in packaging/bundle/bundled.txt")


class Part:
    """A source package of Debian, or the bundle of the 3-D view."""

    def __init__(self, name, version, place, purl, licence, how, text):
        self.name, self.version, self.place, self.purl, self.text = name, version, place, purl, text
        self.licences, self.how, self.files = {licence}, how, set()

    def spdx_id(self):
        return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", self.name)


def debian_part(path, licence, how):
    package = dpkg("dpkg-query", "-S", path).split(":")[0]
    source, version = dpkg("dpkg-query", "-W", "-f=${source:Package} ${source:Version}\n", package).splitlines()[0].split()
    return Part(source, version, f"https://snapshot.debian.org/package/{source}/{version}/", f"pkg:deb/debian/{source}@{version}?arch=source",
                licence, how, pathlib.Path("/usr/share/doc", package, "copyright"))


def parts(maps, carried):
    rows = table()
    compiler_header = [p for p in ("/usr/include/Random123/philox.h",) if os.path.exists(p)]
    found = [(path, licence_of(path, rows), "STATIC_LINK") for path in archives(maps)]
    for path in carried:
        rows_of = [licence for shared, licence in rows.values() if shared == os.path.basename(path)]
        found.append((path, rows_of[0] if rows_of else fail(f"{path} is carried, and is not in packaging/bundle/bundled.txt"), "DYNAMIC_LINK"))
    found += [(path, rows["Random123/philox.h"][1], "STATIC_LINK") for path in compiler_header]
    found += [(f"/usr/share/fonts/truetype/dejavu/{name}", row[1], "CONTAINS") for name, row in rows.items() if row[0] == "font"]
    made = {}
    for path, licence, how in found:
        part = debian_part(path, licence, how)
        part = made.setdefault(part.name, part)
        part.licences.add(licence)
        part.files.add(os.path.basename(path))
    version = json.loads((ROOT / "web/package.json").read_text())["devDependencies"]["three"]
    made["three"] = Part("three", version, f"https://registry.npmjs.org/three/-/three-{version}.tgz", f"pkg:npm/three@{version}", rows["three"][1],
                         "CONTAINS", ROOT / "web/dist/LICENSE-three.txt")
    return [made[name] for name in sorted(made)]


def write_licences(folder, every):
    """A text for each part, and those of Debian's common ones that they refer to."""
    texts = folder / "licences"
    texts.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / "LICENSE", folder / "LICENSE")
    common = set()
    for part in every:
        text = part.text.read_text(errors="replace")
        (texts / f"{part.name}.txt").write_text(text)
        common |= set(re.findall(r"/usr/share/common-licenses/([A-Za-z]+-[0-9.]*[0-9]|[A-Z]\w+)", text))
    for name in sorted({(COMMON / name).resolve().name for name in common if (COMMON / name).is_file()}):
        shutil.copyfile(COMMON / name, texts / f"common-{name}.txt")
    (texts / "README.txt").write_text(
        "Licence texts of what clast's binary holds of others; clast's own is LICENSE. A NAME.txt is Debian's copyright file of the source\n"
        "package NAME (it covers all of that package, also what is not in this binary); common-*.txt are texts that those refer to.\n"
        "The list of parts (*.spdx.json) has their versions and where each source lies, cairo's (MPL-1.1) too; Debian built them.\n")


def digest(kind, path):
    return hashlib.new(kind, pathlib.Path(path).read_bytes()).hexdigest()


def document(every, files, version, epoch):
    extracted = {"LicenseRef-HDF5": ("hdf5", "BSD-like licence of The HDF Group"),
                 "LicenseRef-glibc": ("glibc", "LGPL-2.1-or-later with leave to link libc_nonshared.a into any program")}
    packages = [{"name": "clast", "SPDXID": "SPDXRef-clast", "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
                 "licenseConcluded": "BSD-3-Clause", "licenseDeclared": "BSD-3-Clause", "copyrightText": "Copyright (c) 2026, the clast maintainers",
                 "primaryPackagePurpose": "APPLICATION"}]
    links = [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-clast"}]
    used = set()
    for part in every:
        licence = " AND ".join(f"({x})" if " OR " in x and len(part.licences) > 1 else x for x in sorted(part.licences))
        used |= set(re.findall(r"LicenseRef-[\w.-]+", licence))
        packages.append({"name": part.name, "SPDXID": part.spdx_id(), "versionInfo": part.version, "downloadLocation": part.place,
                         "supplier": "NOASSERTION" if part.name == "three" else "Organization: Debian", "filesAnalyzed": False,
                         "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION",
                         "comment": f"licence text: {part.name}.txt" + (f"; from {', '.join(sorted(part.files))}" if part.files else ""),
                         "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": part.purl}]})
        links.append({"spdxElementId": "SPDXRef-clast", "relationshipType": part.how, "relatedSpdxElement": part.spdx_id()})
    listed = [{"fileName": f"./{name}", "SPDXID": f"SPDXRef-file-{i}", "copyrightText": "NOASSERTION", "licenseConcluded": "NOASSERTION",
               "licenseInfoInFiles": ["NOASSERTION"],
               "checksums": [{"algorithm": kind.upper(), "checksumValue": digest(kind, name)} for kind in ("sha1", "sha256")]}
              for i, name in enumerate(files)]
    links += [{"spdxElementId": "SPDXRef-clast", "relationshipType": "CONTAINS", "relatedSpdxElement": f["SPDXID"]} for f in listed]
    name = f"clast-{version}-{digest('sha256', files[0])[:16]}"
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
            "documentNamespace": f"https://spdx.org/spdxdocs/{name}",
            "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch)), "creators": ["Tool: clast-tools-sbom.py"]},
            "packages": packages, "files": listed, "relationships": links,
            "hasExtractedLicensingInfos": [{"licenseId": x, "name": extracted[x][1], "extractedText": next(
                p.text.read_text(errors="replace") for p in every if p.name == extracted[x][0])} for x in sorted(used)]}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--map", nargs="+", required=True)
    parser.add_argument("--carried", nargs="*", default=[])
    words = parser.parse_args()
    version = (ROOT / "VERSION").read_text().strip()
    every = parts(words.map, words.carried)
    write_licences(words.folder, every)
    text = json.dumps(document(every, words.files, version, int(os.environ.get("SOURCE_DATE_EPOCH", "0"))), indent=1)
    (words.folder / "sbom.spdx.json").write_text(text + "\n")
    print(f"sbom: {len(every)} parts of others: {', '.join(part.name for part in every)}")


main()
