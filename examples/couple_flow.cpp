// couple_flow.c in C++17: the same loop on the solver's own vectors, and the same output.
//
//     c++ -std=c++17 -ffp-contract=off couple_flow.cpp $(pkg-config --cflags --libs clast) &&
//     ./a.out
#include <clast/workspace.h>
#include <clast/agglomerate.h>
#include <clast/cloud.h>
#include <clast/decompose.h>
#include <clast/kernel.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

namespace
{

constexpr int n_step = 60, every = 10;

void check(clast_status status)
{
    if (status != CLAST_OK) {
        throw std::runtime_error(clast_error_detail());
    }
}

struct destroy {
    void operator()(clast_workspace *workspace) const
    {
        clast_workspace_destroy(workspace);
    }
};

struct particles {
    std::vector<double> x, velocity, radius, mass;
    std::vector<std::int64_t> monomers, owner;

    explicit particles(std::size_t n)
        : x(2 * n), velocity(2 * n), radius(n, 1.0), mass(n, 1.0), monomers(n, 1), owner(n)
    {
        std::uint64_t dice = 1; // independent of each other, see couple_flow.c
        for (double &coordinate : x) {
            dice = dice * 6364136223846793005U + 1442695040888963407U;
            coordinate = static_cast<double>(dice >> 11U) * 0x1p-53;
        }
        for (std::size_t i = 0; i < n; ++i) {
            owner[i] = static_cast<std::int64_t>(i);
        }
    }

    /// The flow solver's part: a vortex in the unit square drags the particles along.
    void move(double dt)
    {
        for (std::size_t i = 0; i < owner.size(); ++i) {
            const double a = CLAST_PI * x[2 * i];
            const double b = CLAST_PI * x[2 * i + 1];
            const double fluid[2] = {std::sin(a) * std::cos(b), -std::cos(a) * std::sin(b)};
            for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
                velocity[k] += dt / 0.2 * (fluid[k - 2 * i] - velocity[k]);
                x[k] += dt * velocity[k];
                if (x[k] < 0.0 || x[k] > 1.0) { // bounce off the wall
                    x[k] = x[k] < 0.0 ? -x[k] : 2.0 - x[k];
                    velocity[k] = -velocity[k];
                }
            }
        }
    }
};

/// Cells that follow the particles, in memory that is kept.
class coupling
{
    std::unique_ptr<clast_workspace, destroy> workspace;
    clast_decompose_config config{};
    clast_domain square{};
    std::vector<double> live, volume;
    std::vector<std::int32_t> cell;

  public:
    const clast_decomposition *mesh = nullptr;
    double hidden = 0.0; ///< pairs that cells hide, as the last ones knew that were resolved

    coupling()
    {
        clast_workspace *made = nullptr;
        clast_workspace_policy policy{};
        check(clast_workspace_create(&made));
        workspace.reset(made);
        check(clast_domain_parse("box:0,0,1,1", &square));
        check(clast_fields_default(clast_workspace_fields, &policy));
        policy.tests = CLAST_TESTS_MOVED;
        policy.cells = CLAST_CUT_CHANGED;
        check(clast_workspace_set_policy(made, &policy));
        check(clast_fields_default(clast_decompose_fields, &config));
        config.mesh = CLAST_CELLS_TREE;
    }
    coupling(const coupling &) = delete;
    coupling &operator=(const coupling &) = delete;
    ~coupling()
    {
        clast_fields_free(clast_decompose_fields, &config);
    }

    /// Cells of the particles that are there; volumes corrected for the pairs that cells hide.
    void make_cells(const particles &p)
    {
        const std::size_t n = p.owner.size();
        live.clear();
        for (std::size_t i = 0; i < n; ++i) {
            if (p.monomers[i] > 0) {
                live.insert(live.end(), {p.x[2 * i], p.x[2 * i + 1]});
            }
        }
        clast_points points{};
        points.n = static_cast<std::int64_t>(live.size() / 2);
        points.dimension = 2;
        points.x = live.data();
        points.stride = 2;
        points.axis_stride = 1;
        check(clast_workspace_decompose_in(workspace.get(), &square, &points, &config, &mesh));
        cell.assign(n, -1);
        for (std::size_t i = 0, k = 0; i < n; ++i) {
            cell[i] = p.monomers[i] > 0 ? mesh->cells.of_point[k++] : -1;
        }
        hidden = mesh->resolved ? mesh->smoothing_bias : hidden;
        volume.assign(mesh->cells.volume, mesh->cells.volume + mesh->cells.n);
        for (double &v : volume) {
            v *= 1.0 + hidden;
        }
    }

    std::int64_t collide(particles &p, clast_workspace_step now, const clast_collide_config &how)
    {
        clast_population all{};
        all.n = static_cast<std::int64_t>(p.owner.size());
        all.dimension = 2;
        all.x = p.x.data();
        all.monomers = p.monomers.data();
        all.radius = p.radius.data();
        all.mass = p.mass.data();
        all.velocity = p.velocity.data();
        all.owner = p.owner.data();
        clast_collide_cells cells{};
        cells.n = mesh->cells.n;
        cells.of_particle = cell.data();
        cells.volume = volume.data();
        std::int64_t n_event = 0;
        check(clast_workspace_collide(workspace.get(), &all, &cells, now, &how, &n_event));
        return n_event;
    }
};

void run()
{
    particles p(4000);
    coupling loop;
    clast_collide_config how{};
    check(clast_collide_config_default(&how));
    how.medium.constant = 2e-5;
    how.seed = 1;
    check(clast_kernel_parse("constant", &how.kernel));
    const double dt = 0.02;
    for (int step = 1; step <= n_step; ++step) {
        p.move(dt);
        loop.make_cells(p);
        const std::int64_t n_event = loop.collide(p, {dt, static_cast<std::uint64_t>(step)}, how);
        if (step % every == 0) {
            std::printf(
                "step %d: %lld particles, %d cells, pairs corrected by %+.1f %%, %lld events\n",
                step, static_cast<long long>(loop.mesh->n - n_event), loop.mesh->cells.n,
                100.0 / (1.0 + loop.hidden) - 100.0, static_cast<long long>(n_event));
        }
    }
}

} // namespace

int main()
{
    try {
        run();
    } catch (const std::exception &fault) {
        (void)std::fprintf(stderr, "%s\n", fault.what());
        return 1;
    }
    return 0;
}
