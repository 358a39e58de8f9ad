"""Writes calls.inc: every public struct filled from bytes, every public function called with what was filled.

Read from the headers themselves (make_calls.py INCLUDE_FOLDER OUT), so that a new struct or function is called from its first day.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from headers import HEAP, Declared, Headers  # noqa: E402

SCALARS = {"double": "f64", "float": "f32", "bool": "flag", "size_t": "size", "int": "int", "char": "char", "uint8_t": "u8",
           "unsigned char": "u8", "int32_t": "i32", "int64_t": "i64", "uint32_t": "u32", "uint64_t": "u64"}
COUNTS = re.compile(r"^(n|n_\w+|\w*capacity|size|width|height|degree|argc|count)$")
# Arguments that may be NULL by the header; all others are refused with CLAST_E_ARGUMENT or CLAST_E_CONFIG.
OPTIONAL = {
    "monitor", "comm", "clast_aggregate_achieved.sizes", "clast_aggregate_chart_write.wanted", "clast_aggregate_chart_svg.wanted",
    "clast_aggregate_charts_write.wanted", "clast_aggregate_fit_study.folder", "clast_aggregate_run.folder",
    "clast_assembly_add_shape.shape_id", "clast_collide.n_event", "clast_workspace_collide.n_event", "clast_comm_agree.text", "clast_domain_read.unit",
    "clast_assembly_write.options", "clast_assembly_write.report", "clast_fabric.period", "clast_fill.report",
    "clast_form_set_of.columns", "clast_grading_compare.grading", "clast_grain_statistics_of.bootstrap",
    "clast_grain_statistics_of.columns", "clast_harmonics_mass.area", "clast_sha256_file.n_byte", "clast_mesh_read.report",
    "clast_mesh_read_welded.weld", "clast_mesh_require_solid.otherwise", "clast_mesh_parse.report", "clast_mesh_write.options",
    "clast_mesh_weld.n_merged", "clast_mesh_repair.config", "clast_mesh_repair.report", "clast_mesh_weld_auto.report",
    "clast_mesh_simplify.report", "clast_assembly_find_contacts_periodic.period", "clast_assembly_overlaps.period",
    "clast_pack_run.folder", "clast_evolve_run.folder", "clast_packing_read.options", "clast_packing_read.report", "clast_cloud_read.options",
    "clast_cloud_parse.options",
    "clast_form_inputs_of.pick", "clast_form_inputs_from_moments.deviation", "clast_porosity_predict_set.bootstrap",
    "clast_report_write.config", "clast_assembly_rigid.added", "clast_run_folder_end.run", "clast_spheres_read.name",
    "clast_spheres_write.unit", "clast_state_write_assembly.config", "clast_state_read_spheres.name",
    "clast_statistics_of.bootstrap", "clast_assembly_radial_profile.centre", "clast_table_add_number.number",
    "clast_table_read_csv.options", "clast_table_read_csv.report", "clast_table_parse_csv.options",
    "clast_table_parse_csv.report"}
# Objects that a call changes; other arguments that are not const are outputs.
CHANGED = {
    "clast_mesh_append.mesh", "clast_mesh_transform.mesh", "clast_mesh_weld_auto.mesh", "clast_mesh_round_float.mesh",
    "clast_assembly_add_shape.assembly", "clast_assembly_add_grain.assembly", "clast_assembly_add_contact.assembly",
    "clast_assembly_find_contacts.assembly", "clast_assembly_find_contacts_periodic.assembly", "clast_table_add_number.table",
    "clast_table_add_text.table", "clast_table_set_text.table", "clast_table_resize.table", "clast_collide.population",
    "clast_workspace_collide.particles", "clast_statistics_limit_pca.statistics", "clast_volume_fill.volume",
    "clast_volume_parts.volume", "clast_bed_wrap.assembly", "clast_bed_measure.assembly", "clast_grain_scale.grain", "clast_grains_to_metres.grains",
    "clast_workspace_collide.population", "clast_bed_read.surface", "clast_bed_load.surface"}
# Objects of these types are made anew for each call (calls.h); others are NULL.
LIVE = {"clast_aggregate", "clast_bvh", "clast_dem", "clast_grading", "clast_manifest", "clast_workspace"}
# Of these one that is good but for one number alone: what they write is spread by the caller's stride.
SPREAD = {"clast_workspace"}
# Structs of which calls.h has one that holds together, for calls of which one number alone is wrong.
GOOD = {"clast_assembly", "clast_bed", "clast_cloud", "clast_curve", "clast_domain", "clast_mesh", "clast_points", "clast_shape",
        "clast_sizes", "clast_spheres", "clast_table"}
# What a caller asks for: none of its numbers may be NaN, no enumerator unknown.
ASKED = re.compile(r"_(options|config|drive|period|bootstrap|motion|fluid|step|policy|grain)$")
# Not called with filled structs: what they do is outside the process or takes minutes by design. Each is called with NULL.
PASSING = {"clast_comm_agree", "clast_run_folder_end"}  # give back the status that they are given
LONG = {"clast_outputs_abandon", "clast_study_run", "clast_pack_run", "clast_pack_resume", "clast_evolve_run",
        "clast_evolve_resume", "clast_aggregate_run", "clast_aggregate_resume", "clast_aggregate_fit_study",
        "clast_aggregate_fit_run", "clast_run_folder_begin", "clast_dem_scene_p1", "clast_dem_scene_e1", "clast_dem_scene_s1", "clast_parallel_set_threads", "clast_memory_set_limit"}


class Writer:
    def __init__(self, headers):
        self.h = headers
        self.h.copied = {n for n in GOOD if f"{n}_copy(" in headers.raw}
        self.lines = []

    def value(self, d, where, owner=""):
        """C that fills the object `where` of the declared type."""
        pointer = d.stars > 0
        if d.is_function or (pointer and d.type == "void"):
            return f"{where} = NULL;"
        if pointer:
            if d.type == "char":
                one = "take_path(s)" if d.name in ("path", "folder") else "take_text(s)"
                return f"{where} = (void *){one if d.stars == 1 and not d.is_row else 'take_texts(s)'};"
            if d.type in self.h.opaque:
                return f"{where} = NULL;"
            if d.type in self.h.structs and d.stars == 1:
                return f"{where} = (void *)take_{d.type}(s);"
            if d.type in SCALARS and (d.stars == 1):
                return f"{where} = (void *)take_array_{SCALARS[d.type]}(s);"
            if d.type in self.h.enums and d.stars == 1:
                return f"{where} = (void *)take_array_i32(s);"
            return f"{where} = NULL;"
        if d.dims and d.type == "char":
            return f"take_label(s, (char *){where}, sizeof {where});"
        if d.dims:
            flat = where + "".join("[0]" for _ in d.dims)
            one = Declared(f"{d.type} {d.name}")
            return (f"for (size_t k = 0; k < sizeof {where} / sizeof {flat}; ++k) "
                    f"{{ {self.value(one, f'(&{flat})[k]', owner)} }}")
        if d.type in self.h.structs:
            return f"fill_{d.type}(s, &{where});"
        if d.type in self.h.enums and owner:
            return f'{where} = ({d.type})take_number_choice(s, "{owner}.{d.name}");'
        if d.type in self.h.enums:
            return f"{where} = ({d.type})take_choice(s);"
        if d.type == "double" and owner:
            return f'{where} = take_number(s, "{owner}.{d.name}");'
        if d.type in SCALARS:
            kind = "count" if COUNTS.match(d.name) and SCALARS[d.type] in ("int", "i32", "i64", "size") else SCALARS[d.type]
            return f"{where} = ({d.type})take_{kind}(s);"
        raise SystemExit(f"calls: {d.text}: unknown type {d.type}")

    def struct(self, name, fields):
        self.lines += [f"static void fill_{name}(source *s, {name} *p)", "{", "    memset(p, 0, sizeof *p);",
                       "    if (s->depth > 3) { return; }", "    ++s->depth;"]
        if name.endswith("_config") and name[:-len("_config")] + "_fields" in self.h.raw:
            self.lines += [f"    if (s->is_good) {{ (void)clast_fields_default({name[:-len('_config')]}_fields, p); --s->depth; return; }}"]
        owner = name if ASKED.search(name) else ""
        self.lines += [f"    {self.value(d, 'p->' + d.name, owner)}" for d in fields]
        self.lines += ["    --s->depth;", "}", f"static {name} *take_{name}(source *s)", "{"]
        if name in GOOD:
            self.lines += [f"    if (s->is_good) {{ return good_{name}(); }}"]
        self.lines += [
            f"    {name} *p = take_items(s, sizeof *p);",
            f"    for (int i = 0; p != NULL && i < ITEMS; ++i) {{ s->is_other = i > 0; fill_{name}(s, p + i); }}", "    s->is_other = false;", "    return p;", "}"]

    def argument(self, name, a, k):
        """Declaration, value and clean-up of argument k."""
        key = f"{name}.{a.name}"
        pointer = a.stars > 0 or a.dims
        null = f"null == {k} ? NULL : "
        if not pointer:
            return [f"{a.type} a{k} = {{0}};" if a.type in self.h.structs else f"{a.type} a{k};", self.value(a, f"a{k}", name)], f"a{k}", []
        if a.type == "clast_idle" and a.is_const:  # a list that ends with {0}
            return [], f'{null}(const clast_idle[]){{{{true, "level|domain", "here"}}, {{0}}}}', []
        if a.type == "clast_field":
            return [], f"{null}clast_decompose_fields", []
        if a.type == "void" and a.name == "config":
            return [], f"{null}(void *)config_of_fields()", []
        if name in HEAP:
            return [], "NULL", []
        if a.type == "clast_comm":
            return [], f"{null}take_comm(s)", []
        if a.type == "void":
            return [], f"{null}take_bytes(s)", []
        if a.type in self.h.opaque and a.stars == 1:
            live = a.type in LIVE and not name.endswith("_destroy")
            if a.type in SPREAD and live:
                return [], f"{null}s->is_good || null >= 0 ? live_{a.type}() : NULL", []
            return [], null + (f"live_{a.type}()" if live else "NULL"), []
        if name.endswith(("_free", "_unload")) or key in CHANGED:
            lines = [f"{a.type} a{k} = {{0}};"]
            if key in CHANGED:
                copy = a.type in self.h.copied
                lines.append(f"s->is_hollow = true; fill_{a.type}(s, &a{k}); s->is_hollow = false;" if not copy else
                             f"if (s->is_good) {{ (void){a.type}_copy(good_{a.type}(), &a{k}); }} "
                             f"else {{ s->is_hollow = true; fill_{a.type}(s, &a{k}); s->is_hollow = false; }}")
            return lines, f"{null}&a{k}", []
        if a.is_const or (a.type == "char" and a.stars > 1 and a.name in ("argv",)):
            one = Declared(a.text)
            if a.dims and not a.stars:
                one.dims, one.stars = [], 1
            return [f"void *a{k};", self.value(one, f"a{k}")], f"{null}a{k}", []
        # an output
        lines = [f"void *a{k} = take_output(s);"]
        clean = []
        if a.type in self.h.free and a.stars == 1:
            clean = [f"{self.h.free[a.type]}(a{k});"]
        elif a.type in self.h.destroy and a.stars == 2:
            clean = [f"{self.h.destroy[a.type]}(*({a.type} **)a{k});"]
        elif a.type == "char" and a.stars == 2:
            clean = [f"clast_text_free(*(char **)a{k});"]
        elif a.type == "unsigned char" and a.stars == 2:
            clean = [f"clast_chart_bytes_free(*(unsigned char **)a{k});"]
        return lines, f"{null}a{k}", [f"if (null != {k}) {{ {c} }}" for c in clean]

    def call(self, result, name, arguments):
        setup, values, clean = [], [], []
        for k, a in enumerate(arguments):
            lines, value, free = self.argument(name, a, k)
            setup += lines
            values.append(value)
            clean += free
        self.lines += [f"static int call_{name}(source *s, int null)", "{", "    (void)s; (void)null;"]
        self.lines += [f"    {line}" for line in setup]
        call = f"{name}({', '.join(values)})"
        if result == "clast_status":
            self.lines += [f"    const clast_status status = {call};", "    if (status == CLAST_OK) {"]
            self.lines += [f"        {line}" for line in clean] + ["    }", "    return (int)status;", "}"]
        else:
            self.lines += [f"    {'' if result == 'void' else '(void)'}{call};", "    return -1;", "}"]

    def table(self):
        self.lines += ["static const public_call calls[] = {"]
        for result, name, arguments in self.h.functions:
            need = [k for k, a in enumerate(arguments) if (a.stars or a.dims) and a.name not in OPTIONAL and f"{name}.{a.name}" not in OPTIONAL]
            pointers = [k for k, a in enumerate(arguments) if a.stars or a.dims]
            mask = sum(1 << k for k in need)
            self.lines.append(f'    {{"{name}", call_{name}, {sum(1 << k for k in pointers)}u, {mask}u, '
                              f'{str(name in LONG).lower()}, {str(result == "clast_status" and name not in PASSING).lower()}}},')
        self.lines.append("};")


def main():
    headers = Headers(sys.argv[1])
    writer = Writer(headers)
    for name in headers.structs:
        writer.lines.append(f"static void fill_{name}(source *s, {name} *p);")
        writer.lines.append(f"static {name} *take_{name}(source *s);")
    for name, fields in headers.structs.items():
        writer.struct(name, fields)
    for function in headers.functions:
        writer.call(*function)
    writer.table()
    text = f"// {len(headers.structs)} structs, {len(headers.functions)} functions; written by make_calls.py\n" + "\n".join(writer.lines) + "\n"
    pathlib.Path(sys.argv[2]).write_text(text)


main()
