// clast pack: pour, shake and damp a bed of grains by the discrete element method.
#include "command.h"
#include "packing.h"
#include "quantity.h"
#include "resume.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static clast_status resume(const cli_common *common, const clast_pack_config *config,
                           const clast_monitor *monitor, clast_pack_result *result)
{
    const clast_status status =
        cli_agree(common, cli_resume_check(common, config->resume, clast_pack_fields, config,
                                           sizeof *config, "max_steps"));
    return status != CLAST_OK ? status
                              : clast_pack_resume(config->resume, config->max_steps, common->comm,
                                                  monitor, result);
}

/// One line for the hull of a surface.
static void print_hull(const clast_pack_hull *hull)
{
    if (isfinite(hull->volume_added)) {
        (void)printf("%-26s its hull adds %.3f %% of volume\n", cli_name(hull->shape),
                     100.0 * fmax(hull->volume_added, 0.0));
    } else {
        (void)printf("%-26s hull of a surface without a volume (open or inside out)\n",
                     cli_name(hull->shape));
    }
}

/// What convex hulls add to the surfaces they were taken of: a line each, or one for many.
static void print_hulls(const clast_pack_result *r)
{
    enum { MOST_LINES = 10 };
    double sum = 0.0;
    int32_t n = 0;
    int32_t most = -1;
    for (int32_t i = 0; i < r->n_hull; ++i) {
        const double added = r->hull[i].volume_added;
        if (r->n_hull <= MOST_LINES) {
            print_hull(&r->hull[i]);
        }
        if (isfinite(added)) {
            most = most < 0 || added > r->hull[most].volume_added ? i : most;
            sum += added;
            ++n;
        }
    }
    if (r->n_hull > MOST_LINES && most >= 0) {
        (void)printf("%-26s %d surfaces; they add %.3f %% of volume in the mean, %.3f %% at most "
                     "(%s)\n",
                     "convex hulls", n, 100.0 * fmax(sum / n, 0.0),
                     100.0 * fmax(r->hull[most].volume_added, 0.0), r->hull[most].shape);
    }
    if (r->n_hull > MOST_LINES && n < r->n_hull) {
        (void)printf("%-26s %d of surfaces without a volume (open or inside out)\n", "convex hulls",
                     r->n_hull - n);
    }
}

static void print_no_porosity(const clast_pack_result *r)
{
    if (r->porosity_state == CLAST_PACK_ABOVE_CUT) {
        (void)printf("%-26s none: no slice is denser than the cut of %g, the least porosity of "
                     "one is %.4f; give a greater --cut (or lower slices, --layer)\n",
                     "bulk porosity", r->cut, r->porosity_least);
    } else if (isfinite(r->top)) {
        (void)printf("%-26s none: the bed is %s high and %s are left out at both ends; "
                     "give a smaller --trim; %.4f with nothing left out\n",
                     "bulk porosity", cli_quantity(r->top, "m"), cli_quantity(r->trim, "m"),
                     r->untrimmed);
    } else if (r->porosity_state == CLAST_PACK_FALLING) {
        (void)printf("%-26s none: there is no bed yet, more than half of the grains touch "
                     "nothing\n",
                     "bulk porosity");
    } else {
        (void)printf("%-26s none: there is no bed yet\n", "bulk porosity");
    }
}

static void print_frames(const clast_pack_result *r)
{
    if (r->n_frame > 0) {
        (void)printf("%-26s %lld, every %s of the simulation (frames.pvd)\n", "frames",
                     (long long)r->n_frame, cli_quantity(r->frame_interval, "s"));
    } else if (r->frame_interval > 0.0) {
        (void)printf("%-26s none: the run ended before the first, at %s\n", "frames",
                     cli_quantity(r->frame_interval, "s"));
    }
}

/// What still moves, and what that says of the rule that ended the run.
static void print_motion(const clast_pack_result *r)
{
    static const double MOST_DIAMETERS = 10.0; // a second: grains that go faster are not still
    if (r->dem.n_grain > 0) {
        (void)printf("%-26s %s the fastest grain; %d of %d with fewer than four contacts, "
                     "walls counted\n",
                     "motion", cli_quantity(r->dem.max_speed, "m/s"), r->n_loose, r->dem.n_grain);
    }
    if (r->phase == CLAST_PACK_DONE && r->is_moving && r->n_stage == 0) {
        (void)printf("%-26s the bed was level and still moves: its fastest grain is not below "
                     "still_speed; --rule speed waits until it is\n",
                     "warning");
    }
    if (r->dem.n_grain > 0 && r->n_stage == 0 && r->cell.side[2] == 0.0 &&
        r->still_diameters > MOST_DIAMETERS) {
        (void)printf("%-26s still_speed is %.3g diameters of the smallest grain a second: for "
                     "such grains take a lower --still-speed, and --height-change with it\n",
                     "note", r->still_diameters);
    }
    if (r->fell) {
        (void)printf("%-26s shaking ended while grains fell: the highest sank by %s since; "
                     "take a longer --shaking-time\n",
                     "warning", cli_quantity(r->sank, "m"));
    }
}

/// How far the side walls are: a narrow bed is looser for them.
static void print_walls(const clast_pack_result *r)
{
    const clast_bed_walls *walls = &r->walls;
    if (isinf(walls->ratio)) {
        (void)printf("%-26s none: the bed is periodic\n", "side walls");
    } else if (isfinite(walls->ratio)) {
        (void)printf("%-26s %.4g grain sizes (of %s, mean by volume) from the axis, which "
                     "loosen the bed",
                     "side walls", walls->ratio, cli_quantity(walls->size, "m"));
        if (isfinite(r->wall_share)) {
            (void)printf(": %.4f of the bulk porosity is theirs", r->wall_share);
        }
        (void)puts("");
    }
}

/// How the bed was divided among ranks, and what went between them.
static void print_ranks(const clast_pack_ranks *r)
{
    if (r->n <= 1) {
        return;
    }
    (void)printf("%-26s %d, by %s; cost of the most loaded %.3f of the mean\n", "ranks", r->n,
                 r->is_zoltan ? "Zoltan" : "clast's own bisection", r->imbalance);
    if (r->n_idle > 0) {
        (void)printf("%-26s %d of %d ranks have no grain: too many for this bed\n", "warning",
                     r->n_idle, r->n);
    }
    (void)printf("%-26s %.4g ghosts, %.4g bytes and %.4g messages a step, %.4g bytes for lists; "
                 "%lld grains moved in %lld partitions\n",
                 "between ranks", r->ghosts, r->step_bytes, r->messages, r->list_bytes,
                 (long long)r->n_migrated, (long long)r->n_balance);
}

/// What a loaded bed carries; stresses of contacts and motion.
static void print_load(const clast_pack_result *r)
{
    const double *c = r->load.stress;
    const double *k = r->load.kinetic_stress;
    if (r->load.volume > 0.0) {
        const double most = fmax(fabs(c[0] + k[0]), fmax(fabs(c[1] + k[1]), fabs(c[2] + k[2])));
        (void)printf(
            "%-26s %s, %s, %s in x, y, z; xz %s\n", "stress",
            cli_quantity_as(c[0] + k[0], "Pa", most), cli_quantity_as(c[1] + k[1], "Pa", most),
            cli_quantity_as(c[2] + k[2], "Pa", most), cli_quantity_as(c[4] + k[4], "Pa", most));
        (void)printf("%-26s %.4g, %.4g, %.4g in x, y, z, above 0 pressed; shear %.4g\n", "strain",
                     r->cell.strain[0], r->cell.strain[1], r->cell.strain[2], r->cell.shear_strain);
        (void)printf("%-26s %d of %d grains; %.3f contacts a grain without them\n", "rattlers",
                     r->load.n_rattler, r->dem.n_grain, r->load.coordination_held);
    }
}

/// Where the energy went, in shares of what was put in, which add up to all of it.
static void print_energy(const clast_pack_result *r)
{
    const clast_dem_energy *e = &r->energy;
    const struct {
        double part;
        const char *name;
        bool is_always;
    } share[] = {
        {e->translation + e->rotation, "kinetic", true},
        {e->normal_springs + e->tangential_springs + e->attraction, "in contacts", true},
        {e->damping[0] + e->damping[1], "lost in dashpots", true},
        {e->friction[0] + e->friction[1], "by friction", true},
        {e->rolling[0] + e->rolling[1], "by rolling", false},
        {e->fluid, "to the fluid", false},
        {e->calming, "by damping all velocities", false},
        {e->left, "gone with grains", false},
        {e->scheme, "by the scheme", true},
    };
    if (!(e->put_in > 0.0)) {
        return;
    }
    (void)printf("%-26s %s put in: ", "energy", cli_quantity(e->put_in, "J"));
    for (size_t k = 0; k < sizeof share / sizeof share[0]; ++k) {
        if (share[k].is_always || share[k].part != 0.0) {
            (void)printf("%s%.3g %% %s", k > 0 ? ", " : "", 100.0 * share[k].part / e->put_in,
                         share[k].name);
        }
    }
    (void)printf("; %.1g %% not accounted for\n", 100.0 * e->rest / e->put_in);
}

/// What was asked for and what the grains are, where these differ.
static void print_mass(const clast_pack_result *r)
{
    static const double MOST_MASS = 1.5; // of what was wanted
    if (r->mass_wanted > 0.0 && r->n_left == 0 && r->dem.mass > MOST_MASS * r->mass_wanted) {
        (void)printf("%-26s %.3g times the mass that was asked for: %s one grain weighs; give "
                     "more --mass or smaller grains\n",
                     "warning", r->dem.mass / r->mass_wanted,
                     cli_quantity(r->dem.mass / r->dem.n_grain, "kg"));
    }
    if (r->own_density > 0.0) {
        (void)printf("%-26s aggregates of %s are packed at %s: --density 0 keeps their own\n",
                     "density", cli_quantity(r->own_density, "kg/m^3"),
                     cli_quantity(r->given_density, "kg/m^3"));
    }
}

static void print_text(const clast_pack_result *r)
{
    print_hulls(r);
    (void)printf("%-26s %d in %d fill%s, %s of %s\n", "grains", r->dem.n_grain, r->n_fill,
                 r->n_fill == 1 ? "" : "s", cli_quantity_as(r->dem.mass, "kg", r->mass_wanted),
                 cli_quantity(r->mass_wanted, "kg"));
    print_mass(r);
    if (r->n_overlap > 0) {
        (void)printf(
            "%-26s %lld overlapped, the deepest by %.3g of the smaller one's radius; their "
            "springs separate them\n",
            "start", (long long)r->n_overlap, r->deepest_start);
    }
    if (r->n_waited > 0) {
        (void)printf("%-26s %lld did not fit into one fill and were made in the next\n", "waited",
                     (long long)r->n_waited);
    }
    (void)printf("%-26s %s%s after %lld steps, %s\n", "phase", clast_pack_phase_name(r->phase),
                 r->phase != CLAST_PACK_DONE ? ""
                 : r->n_stage > 0            ? " (all stages)"
                 : r->is_moving              ? " (level)"
                                             : " (at rest)",
                 (long long)r->dem.step, cli_quantity(r->dem.time, "s"));
    print_motion(r);
    if (r->n_left > 0) {
        (void)printf("%-26s %lld grains, %s\n", "left by outlets", (long long)r->n_left,
                     cli_quantity(r->mass_left, "kg"));
    }
    if (r->n_outside > 0) {
        (void)printf("%-26s %d grain%s left the container\n", "outside", r->n_outside,
                     r->n_outside == 1 ? " has" : "s have");
    }
    if (isfinite(r->porosity)) {
        const bool are_spheres = r->flatness[0] == 1.0 && r->elongation[0] == 1.0;
        (void)printf("%-26s %.4f between z = %s and %s%s\n", "bulk porosity", r->porosity,
                     cli_quantity_as(r->z_low, "m", r->z_high), cli_quantity(r->z_high, "m"),
                     are_spheres ? ""
                                 : ", each grain as the sphere of its volume, as published; by "
                                   "true shapes: clast porosity");
    } else {
        print_no_porosity(r);
    }
    print_walls(r);
    (void)printf("%-26s %.3f touching grains a grain (%lld contacts of grains, %lld with walls)\n",
                 "coordination", r->dem.coordination, (long long)r->dem.n_contact,
                 (long long)r->dem.n_wall_contact);
    (void)printf("%-26s %s\n", "deepest overlap", cli_quantity(r->dem.max_overlap, "m"));
    print_load(r);
    print_energy(r);
    if (r->dem.verified.n > 0) {
        (void)printf("%-26s %lld compared, %lld off by more than 0.01 nm, %lld by 10 nm, worst "
                     "%s\n",
                     "remembered contacts", (long long)r->dem.verified.n,
                     (long long)r->dem.verified.n_off, (long long)r->dem.verified.n_bad,
                     cli_quantity(r->dem.verified.worst, "m"));
    }
    print_frames(r);
    print_ranks(&r->ranks);
    (void)printf("%-26s %.4g s, %.4g ns a grain-step\n", "took", r->wall_s,
                 r->clocked_steps > 0.0 ? 1e9 * r->step_s / r->clocked_steps : 0.0);
    (void)printf("%-26s %016llx\n", "state hash", (unsigned long long)r->hash);
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_pack_config *config = context;
    clast_pack_result result = {0};
    const clast_monitor monitor = cli_monitor(common);
    char *text = NULL;
    const clast_status status =
        config->resume[0] != '\0'
            ? resume(common, config, &monitor, &result)
            : clast_pack_run(config, common->output, common->comm, &monitor, &result);
    if (status != CLAST_OK || common->comm->rank > 0) {
        return status;
    }
    cli_packing_note(common, config->start[0] != '\0' ? config->start : "start",
                     &(clast_packing_report){.snapshot = result.start_snapshot,
                                             .n_snapshot = result.n_start_snapshot,
                                             .frame = {.step = result.start_step}});
    if (!common->json) {
        print_text(&result);
        clast_pack_result_free(&result);
        return CLAST_OK;
    }
    const clast_status made = clast_pack_result_json(&result, true, &text);
    if (made == CLAST_OK) {
        (void)puts(text);
    }
    clast_text_free(text);
    clast_pack_result_free(&result);
    return made;
}

static const char details[] =
    "Grains are made in the upper part of the domain and fall, fill after fill, until the mass is\n"
    "reached; shaken meanwhile and for shaking_time more; then damped until the bed is at rest.\n"
    "Defaults are those of Rettinger, Ruede, Vollmer and Frings (eqs 4 to 15, sec. 4); options "
    "name\n"
    "where their program differs. --max-steps ends a run early, as it is then.\n\n"
    "grains.csv has a row a grain: shape, flatness S/I, elongation I/L, sieve_size_m, "
    "density_kg/m^3,\n"
    "centroid x_m, y_m, z_m (in a periodic domain the image about the origin) and the quaternion\n"
    "qw, qx, qy, qz that rotates the shape into its orientation.\n\n"
    "--wall 'drum drum.stl mm axis 0,1,0 rotate 30rpm' adds a surface that moves; floor, lid, "
    "sides,\n"
    "left, right, front and back of the domain may move, too. Without stages they move from the "
    "start;\n"
    "with --stages the bed is poured first, then each stage drives walls: 'drum until time 2s',\n"
    "'lid=10kPa until rest', 'open gate until mass 1g'. --outlet 'z<-10mm' takes grains out. "
    "walls.csv has\n"
    "position, force, torque and work of each wall over time, and the mass that left.\n\n"
    "domain cell is periodic in x, y and z: its grains float on a lattice until the stages press "
    "and\n"
    "shear them (--stages 'isotropic 10kPa until rest'; docs/theory/load.md). load.csv then has "
    "strain,\n"
    "stress (pressure above 0), fabric, contacts and forces over time; with --energy, in any "
    "domain,\n"
    "the work of all forces by kind. until stress P looks in a cell at |stress xz| of a stage "
    "that\n"
    "shears, else at the sides with a rate (from above where they extend), else at those with a\n"
    "pressure; between walls at those that move (from above where they move away), else at those\n"
    "that are pressed.\n\n"
    "With -o RUN: state.h5, series.csv, profile.csv, achieved.csv, grains.csv, summary.json, "
    "manifest.json,\n"
    "charts (energy.svg, profile.svg, achieved.svg), frames for ParaView with --frame-time, and\n"
    "checkpoints on the way: --resume RUN goes on from the newest and ends in the same bytes.\n"
    "A run that --max-steps ended goes on in the same way, to --max-steps N or to its end.\n"
    "A folder that holds a run is refused: go on with it, or replace it with --force\n"
    "(the new run is made in RUN.new and takes its place when it has succeeded).\n"
    "A run that does not come to its end (exit code 5) keeps its state.h5 and tables until "
    "then.\n\n"
    "mpirun -n N clast-mpi pack ... (clast built with MPI) divides one bed among N ranks, by "
    "default\n"
    "of one thread each. State, checkpoints and all files are the bytes of one rank: any number "
    "of\n"
    "ranks, and clast pack, may go on with them.";

const cli_command cli_pack = {
    .name = "pack",
    .arguments = "",
    .summary = "pour, shake and damp a bed of grains (DEM); its porosity",
    .example =
        {"clast pack --curve 4mm --mass 20g --width 2cm --height 9cm --shaking-time 0 --rule speed",
         "clast pack --curve U1 --shapes ellipsoid:1,0.7,0.5 --mass 0.1kg --width 60mm -o bed/",
         "clast pack --resume bed/"},
    .details = details,
    .fields = clast_pack_fields,
    .config_size = sizeof(clast_pack_config),
    .writes_folder = true,
    .shares_ranks = true,
    .run = run,
};
