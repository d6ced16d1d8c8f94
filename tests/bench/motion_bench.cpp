// Speed of motion planning and of the simulated arm. Aims: appending one move 20 us, 1 us a stretch, 4 ms of motion at a
// thousand times real time (4 us a sample).

#include "runtime/motion/axis_profile.h"
#include "runtime/motion/motion_system.h"
#include "runtime/motion/profile_grid.h"
#include "runtime/motion/trajectory.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace {

using namespace motion;

robot::RobotModel arm() {
    auto model = robot::loadRobotModel("IRB 6640-180/2.55");
    if (!model) std::abort();
    return *model;
}

const JointTarget kStart{{0, 10, 10, 0, 60, 0}, kNoExternalAxes};

/// Line to one of the places of a zigzag of 50 mm legs.
MoveCommand zigzag(const robot::Kinematics& kinematics, int n) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target.pose = kinematics.forward(kStart.robax);
    command.target.pose.pos.y += 40 * (n % 10);
    command.target.pose.pos.z += n % 2 == 0 ? 30 : 0;
    command.speed.vTcp = 500;
    command.zone = {false, 10, 15, 15, 1.5, 15, 1.5};
    command.confL = false;
    return command;
}

void resolveMove(benchmark::State& state) {
    const robot::Kinematics kinematics(arm());
    int n = 1;
    JointTarget at = kStart;
    for (auto _ : state) {
        auto path = MotionPath::make(kinematics, at, zigzag(kinematics, n++));
        at = path->end();
        benchmark::DoNotOptimize(path);
    }
}
BENCHMARK(resolveMove);

/// A move appended to a path of `range` moves, whose plan is adapted.
void appendTo(benchmark::State& state, Planner planner) {
    const robot::RobotModel model = arm();
    const robot::Kinematics kinematics(model);
    std::vector<std::shared_ptr<const MotionPath>> paths;
    std::vector<MoveCommand> commands;
    JointTarget at = kStart;
    for (int n = 1; n <= 200; ++n) {
        commands.push_back(zigzag(kinematics, n));
        auto path = MotionPath::make(kinematics, at, commands.back());
        at = path->end();
        paths.push_back(std::make_shared<const MotionPath>(std::move(*path)));
    }
    int64_t stretches = 0;
    std::optional<Trajectory> made;
    TrajectoryOptions options;
    options.planner = planner;
    for (auto _ : state) {
        state.PauseTiming();
        Trajectory& trajectory = made.emplace(model, ExternalAxisModels{}, options, kStart, 0);
        const auto before = static_cast<std::size_t>(state.range(0));
        for (std::size_t n = 0; n < before; ++n)
            trajectory.append(paths[n], commands[n], 0);
        const auto old = static_cast<int64_t>(trajectory.route(0).stretches().size());
        state.ResumeTiming();
        trajectory.append(paths[before], commands[before], 0);
        stretches += static_cast<int64_t>(trajectory.route(0).stretches().size()) - old;
    }
    state.counters["stretches"] = static_cast<double>(stretches) / static_cast<double>(state.iterations());
}
void appendMove(benchmark::State& state) {
    appendTo(state, Planner::Measured);
}
BENCHMARK(appendMove)->Arg(1)->Arg(10)->Arg(60);
void appendOptimal(benchmark::State& state) {
    appendTo(state, Planner::Optimal);
}
BENCHMARK(appendOptimal)->Arg(1)->Arg(10)->Unit(benchmark::kMicrosecond);

/// Motion through zones, a sample each 4 ms, with the events of the moves. Counter: seconds of motion per second.
void simulate(benchmark::State& state) {
    double seconds = 0;
    for (auto _ : state) {
        MotionSystem system(arm());
        system.placeAt(kStart);
        for (int n = 1; n < 100; ++n) {
            const auto id = system.enqueue(zigzag(system.kinematics(), n));
            while (id && !system.isReleased(*id)) {
                const TimeNs tick = (system.now() / 4'000'000 + 1) * 4'000'000;
                system.advanceTo(std::min(tick, system.nextEventTime().value_or(tick)));
                benchmark::DoNotOptimize(system.current());
            }
            system.takeEvents();
        }
        seconds += static_cast<double>(system.now()) * 1e-9;
    }
    state.counters["realtime"] = benchmark::Counter(seconds, benchmark::Counter::kIsRate);
}
BENCHMARK(simulate)->Unit(benchmark::kMillisecond);

/// The fastest speed along a path of `range` cells on which three axes wave. Counter: cells a second. Aim: 1 us a cell.
void solveProfile(benchmark::State& state) {
    std::vector<ProfileCell> path(static_cast<std::size_t>(state.range(0)));
    for (std::size_t i = 0; i < path.size(); ++i) {
        path[i].width = 5;
        path[i].mostSquare = 500 * 500;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto rowAt = [&](double place) {
                const double x = 0.02 * place + static_cast<double>(axis);
                return ProfileRow{std::cos(x), -0.02 * std::sin(x), -4e-4 * std::cos(x), 3000, 3000, 60'000};
            };
            path[i].first.add(rowAt(5 * static_cast<double>(i)));
            path[i].last.add(rowAt(5 * static_cast<double>(i + 1)));
        }
    }
    ProfileSolver solver;
    int64_t cells = 0;
    int iterations = 0;
    for (auto _ : state) {
        const ProfileGrid grid = gridOf(path, {});
        auto found = solver.solve(grid.cells, grid.start, grid.endWidth);
        benchmark::DoNotOptimize(found);
        iterations = found.iterations;
        cells += static_cast<int64_t>(grid.cells.size());
    }
    state.SetItemsProcessed(cells);
    state.counters["iterations"] = iterations;
}
BENCHMARK(solveProfile)->Arg(20)->Arg(200)->Arg(2000);

std::array<AxisLimits, 6> sixLimits() {
    std::array<AxisLimits, 6> limits{};
    for (std::size_t i = 0; i < limits.size(); ++i)
        limits[i] = {1.0 + 0.3 * static_cast<double>(i), 4, 30};
    return limits;
}

/// Six axes from rest to rest, arriving together. Aim: 0.8 us.
void sixAxesRestToRest(benchmark::State& state) {
    std::array<double, 6> from{};
    std::array<double, 6> to{};
    const std::array<AxisLimits, 6> limits = sixLimits();
    std::array<AxisProfile, 6> profiles;
    double change = 0;
    for (auto _ : state) {
        change = change > 3 ? 0 : change + 0.01;
        for (std::size_t i = 0; i < 6; ++i)
            to[i] = 0.01 + change * (1 - 0.3 * static_cast<double>(i));
        restToRestTogether(from, to, limits, profiles);
        benchmark::DoNotOptimize(profiles);
    }
}
BENCHMARK(sixAxesRestToRest);

/// Six axes between states in motion, arriving together. Aim: 6 us.
void sixAxesBetweenStates(benchmark::State& state) {
    std::array<AxisState, 6> from{};
    std::array<AxisState, 6> to{};
    const std::array<AxisLimits, 6> limits = sixLimits();
    std::array<AxisProfile, 6> profiles;
    double change = 0;
    for (auto _ : state) {
        change = change > 3 ? 0 : change + 0.01;
        for (std::size_t i = 0; i < 6; ++i) {
            const double x = change + static_cast<double>(i);
            from[i] = {0, 0.7 * std::sin(x), 1.5 * std::cos(3 * x)};
            to[i] = {2 * std::sin(5 * x), 0.7 * std::cos(2 * x), 1.5 * std::sin(x)};
        }
        betweenTogether(from, to, limits, profiles);
        benchmark::DoNotOptimize(profiles);
    }
}
BENCHMARK(sixAxesBetweenStates);

} // namespace

BENCHMARK_MAIN();
