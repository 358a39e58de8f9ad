// clast evolve: a cloud of particles of true shapes, from the fluid to the floor.
#include "command.h"
#include "points.h"
#include "quantity.h"
#include "resume.h"

#include <math.h>
#include <stdio.h>

static clast_status resume(const cli_common *common, const clast_evolve_config *config,
                           const clast_monitor *monitor, clast_evolve_result *result)
{
    const clast_status status =
        cli_resume_check(common, config->resume, clast_evolve_fields, config, sizeof *config, NULL);
    return status != CLAST_OK ? status : clast_evolve_resume(config->resume, monitor, result);
}

/// The bodies on the floor, means by mass.
static void print_deposit(const clast_evolve_result *r)
{
    if (r->n_deposit == 0) {
        (void)printf("%-26s nothing came down\n", "deposit");
        return;
    }
    (void)printf("%-26s %lld bodies, %s (%.4g %% of the mass)\n", "deposit",
                 (long long)r->n_deposit, cli_quantity(r->mass_deposit, "kg"),
                 100.0 * r->mass_deposit / r->mass_start);
    if (r->n_wall > 0) {
        (void)printf("%-26s %lld bodies, %s, not on the floor\n", "  on walls",
                     (long long)r->n_wall, cli_quantity(r->mass_wall, "kg"));
    }
    (void)printf("%-26s diameter %s and porosity %.3f (of the ellipsoid of equal moments), fall "
                 "%s, %.4g particle%s of the start\n",
                 "  means by mass", cli_quantity(r->deposit_diameter, "m"), r->deposit_porosity,
                 cli_quantity(r->deposit_speed, "m/s"), r->deposit_grains,
                 r->deposit_grains == 1.0 ? "" : "s");
}

static void print_range(const clast_range_use *use)
{
    char words[512];
    if (clast_range_use_words(use, sizeof words, words)[0] != '\0') {
        (void)printf("%-26s %.6g of %.6g collisions: %s\n", "out of range", use->outside, use->n,
                     words);
    }
}

/// One line where bodies fell faster than their drag law holds.
static void warn_of_fall(const cli_common *common, const clast_evolve_result *r)
{
    const double limit = r->fall_reynolds_limit;
    const bool is_stokes = limit < 1.0;
    if (r->fall_reynolds > limit && !common->quiet) {
        (void)fprintf(
            stderr,
            "clast evolve: warning: Reynolds number of the fastest fall is %.2g, beyond the "
            "%g of the drag law%s\n",
            r->fall_reynolds, limit, is_stokes ? " (take --fall form or sphere)" : "");
    }
}

/// One line where a field and the domain are hardly in one unit.
static void warn_of_field(const cli_common *common, const clast_evolve_result *r)
{
    if (r->is_field_apart && !common->quiet) {
        (void)fputs("clast evolve: warning: no body starts within the grid of --field, or it is "
                    "1000 times as wide as the domain; are both in the same unit? (beyond the grid "
                    "the velocity is that at its edge)\n",
                    stderr);
    }
}

/// One line where a floor or top that reflects has a layer that steps do not follow.
static void warn_of_layer(const cli_common *common, const clast_evolve_result *r)
{
    const bool is_top = r->gathered_top > 0.0;
    const bool is_floor = r->gathered_top < r->gathered;
    if (r->gathered > 0.0 && !common->quiet) {
        (void)fprintf(
            stderr,
            "clast evolve: warning: %.3g %% of the mass comes to a %s that reflects and gathers "
            "there in a layer (diffusivity over speed) thinner than a step moves it: what meets "
            "there depends on the steps (take %s%s%s, or shorter steps)\n",
            100.0 * r->gathered,
            !is_top    ? "floor"
            : is_floor ? "floor or top"
                       : "top",
            is_floor ? "--floor deposit" : "", is_floor && is_top ? " and " : "",
            is_top ? "--open-top (a box; else --sides deposit)" : "");
    }
}

/// How clast pack settles the bed: the default times of its contacts are those of grains of
/// millimetres. One that falls through the whole column is stopped within a quarter of the smallest
/// radius, the half of what clast pack allows: v T / pi with v^2 = 2 g H. A step is a fortieth of
/// a collision, as by default there; what moves five of its diameters a second is still, and slices
/// of the porosity profile are as high as one.
static void print_pack(const clast_evolve_result *r)
{
    const double gravity = clast_fields_find(clast_pack_fields, "gravity")->value;
    const double speed = sqrt(2.0 * gravity * r->bed_height);
    const double collision = CLAST_PI * 0.25 * r->bed_least / speed;
    (void)printf("%-26s clast pack --start %s/deposit.h5 --domain box --width %.6gum --height "
                 "%.6gum --shaking-time 0 --collision-time %.3gus --time-step %.3gus --rule speed "
                 "--still-speed %.3gmm/s --layer %.3gum\n",
                 "  settles by", cli_name(r->folder), 1e6 * r->bed_width, 1e6 * r->bed_height,
                 1e6 * collision, 1e6 * collision / 40.0, 1e4 * r->bed_least, 2e6 * r->bed_least);
}

/// deposit.h5, in which a body that stands for others comes once.
static void print_bed(const clast_evolve_result *r)
{
    if (r->is_bed_empty) {
        (void)printf("%-26s none: nothing lies on the floor\n", "bed");
    }
    if (!(r->bed_width > 0.0)) {
        return;
    }
    (void)printf("%-26s %s/deposit.h5: %s wide, %s high", "bed", cli_name(r->folder),
                 cli_quantity(r->bed_width, "m"), cli_quantity(r->bed_height, "m"));
    const double weight = round((r->mass_deposit - r->mass_wall) / r->bed_mass);
    if (weight > 1.0) {
        (void)printf("; each body once, %s, of the %.15g that it stands for",
                     cli_quantity(r->bed_mass, "kg"), weight);
    }
    (void)puts("");
    print_pack(r);
}

static void print_text(const clast_evolve_result *r)
{
    (void)printf("%-26s %lld of %lld at the start, %lld events\n", "particles in the fluid",
                 (long long)r->n_particle, (long long)r->n_start, (long long)r->n_event);
    print_deposit(r);
    if (r->n_out > 0) {
        (void)printf("%-26s %lld bodies, %s by the top\n", "gone", (long long)r->n_out,
                     cli_quantity(r->mass_out, "kg"));
    }
    (void)printf("%-26s %lld particle%s of the start\n", "largest aggregate",
                 (long long)r->grains_most, r->grains_most == 1 ? "" : "s");
    if (isfinite(r->fractal_dimension)) {
        (void)printf("%-26s %.3f +- %.3f (radius of gyration over grains, 10 or more)\n",
                     "fractal dimension", r->fractal_dimension, r->fractal_error);
    }
    (void)printf("%-26s %.2g of the mass, %lld of the number, at the worst row\n", "balance off by",
                 r->mass_balance, (long long)r->number_balance);
    (void)printf("%-26s %s in %lld steps; cells cut %lld times", "time", cli_quantity(r->time, "s"),
                 (long long)r->n_step, (long long)r->n_cut);
    if (r->n_unresolved > 0) {
        (void)printf(", the pairs in them a best guess %lld times", (long long)r->n_unresolved);
    }
    (void)putchar('\n');
    print_range(&r->range);
    if (r->n_frame > 0) {
        (void)printf("%-26s %d (frames.pvd)\n", "frames", r->n_frame);
    }
    if (r->n_written > 0) {
        (void)printf("%-26s %d in %s/aggregates, for clast pack --shapes\n", "aggregates",
                     r->n_written, cli_name(r->folder));
    }
    print_bed(r);
    (void)printf("%-26s %.4g s\n", "took", r->wall_s);
    (void)printf("%-26s %016llx\n", "state hash", (unsigned long long)r->hash);
}

static clast_status run(const cli_common *common, void *context)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *config = context;
    clast_evolve_result result = {0};
    const clast_monitor monitor = cli_monitor(common);
    char *text = NULL;
    if (config->resume[0] != '\0' || (common->output != NULL && !config->force)) {
        cli_signals_way_on("evolve", // a run that replaces another is beside it until its end
                           config->resume[0] != '\0' ? config->resume : common->output);
    }
    CLI_TRY(config->resume[0] != '\0'
                ? resume(common, config, &monitor, &result)
                : clast_evolve_run(config, common->output, &monitor, &result));
    warn_of_fall(common, &result);
    warn_of_layer(common, &result);
    warn_of_field(common, &result);
    cli_warn(common, result.weight_words);
    cli_warn(common, result.points_words);
    if (!common->quiet) {
        char words[CLI_WORDS_SIZE];
        cli_warn(common, clast_kernel_dense_words(result.volume_fraction, sizeof words, words));
    }
    if (!common->json) {
        print_text(&result);
        goto done;
    }
    CLI_TRY(clast_evolve_result_json(&result, true, &text));
    (void)puts(text);
done:
    clast_text_free(text);
    clast_evolve_result_free(&result);
    return status;
}

static const char details[] =
    "Particles fall by the drag of their own form, drift with a linear wind and diffuse, exactly\n"
    "for any step away from the borders (in a velocity field on a grid by steps of Runge and\n"
    "Kutta, a quarter of a cell each). In each step the cloud is cut into cells where it is\n"
    "uniform (D2SD; kept while the tests accept them), with volumes that make up for the pairs "
    "which\n"
    "cells hide; in a cell pairs meet at the rate of the kernel and stick by the law of sticking.\n"
    "Each event is one pair: the smaller comes to the larger and stays where their true surfaces\n"
    "first touch, with the contact of clast aggregate; where few touches stick, at any contact\n"
    "without overlap (--meeting reaction).\n"
    "Mass, moments, porosity, collision radius, fall speed and diffusivity are those of the new\n"
    "aggregate from then on. Its envelope, of which diameter, porosity, density and fall are, is\n"
    "the solid ellipsoid of equal moments: clast aggregate takes others, larger for a core with a\n"
    "coat. grains counts particles of the start; an aggregate that begins as one is one.\n\n"
    "Not modelled: aggregates break, restructure or rotate; particles act on the fluid; the field\n"
    "changes in time; bodies have inertia of their own.\n\n"
    "With --weight W all numbers count bodies, each of which stands for W; masses of balance.csv,\n"
    "spectrum.csv and summary.json are those of all W, masses of events.csv, deposit.csv,\n"
    "particles.csv and frames those of one.\n\n"
    "With -o RUN: balance.csv and spectrum.csv (rows in time), events.csv (the tree by time: node\n"
    "n + k is event k of n particles), deposit.csv, deposit_sizes.csv (of its bodies: diameters "
    "of\n"
    "equal volume, for --curve list:FILE --size-meaning volume), deposit.h5 (--bed-width: those "
    "on\n"
    "the floor, not on walls, as a bed for clast pack --start, each once, above its position and "
    "on\n"
    "those that came before), particles.csv, state.h5 (the aggregate of most grains),\n"
    "aggregates/node-*.h5 (--keep: for clast pack --shapes, clast render, clast export), charts\n"
    "(evolution.svg, spectrum.svg, deposit.svg), summary.json, manifest.json,\n"
    "report.html, frames for ParaView with --frames (with numbers of each grain's body), and "
    "checkpoints\n"
    "on the way: --resume RUN goes on from the newest and ends in the same bytes.";

const cli_command cli_evolve = {
    .name = "evolve",
    .arguments = "",
    .summary = "true shapes in a fluid: fall, meet, join by first touch, deposit",
    .example = {"clast evolve examples/evolve/ash.yaml --duration 100s",
                "clast evolve examples/evolve/flocs.yaml -o flocs/",
                "clast evolve --resume flocs/"},
    .details = details,
    .fields = clast_evolve_fields,
    .config_size = sizeof(clast_evolve_config),
    .writes_folder = true,
    .run = run,
};
