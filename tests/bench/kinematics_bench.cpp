// Speed of the closed-form kinematics. Aims: forward 80 ns, one branch by confdata 120 ns, all eight 350 ns.

#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace {

struct Fixture {
    robot::RobotModel model;
    robot::Kinematics kinematics;
    std::vector<robot::Joints> joints;
    std::vector<robot::Pose> poses;
    std::vector<robot::ConfData> confs;

    Fixture() {
        auto loaded = robot::loadRobotModel("IRB 2400-10/1.55");
        if (!loaded) std::abort();
        model = *loaded;
        kinematics = robot::Kinematics(model);
        std::mt19937_64 random(1);
        for (int n = 0; n < 1024; ++n) {
            robot::Joints q;
            for (std::size_t i = 0; i < q.size(); ++i) {
                q[i] = std::uniform_real_distribution<double>(model.lowerDeg[i], model.upperDeg[i])(random);
            }
            joints.push_back(q);
            poses.push_back(kinematics.forward(q));
            confs.push_back(kinematics.configuration(q));
        }
    }
};

const Fixture& fixture() {
    static const Fixture instance;
    return instance;
}

void forward(benchmark::State& state) {
    const Fixture& f = fixture();
    std::size_t n = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(f.kinematics.forward(f.joints[n++ & 1023]));
}
BENCHMARK(forward);

void inverseByConfiguration(benchmark::State& state) {
    const Fixture& f = fixture();
    std::size_t n = 0;
    for (auto _ : state) {
        const std::size_t i = n++ & 1023;
        benchmark::DoNotOptimize(f.kinematics.inverse(f.poses[i], f.confs[i], f.joints[i]));
    }
}
BENCHMARK(inverseByConfiguration);

void inverseAll(benchmark::State& state) {
    const Fixture& f = fixture();
    std::size_t n = 0;
    robot::IkBranches branches;
    for (auto _ : state) {
        const std::size_t i = n++ & 1023;
        f.kinematics.inverseAll(f.poses[i], f.joints[i], branches);
        benchmark::DoNotOptimize(branches);
    }
}
BENCHMARK(inverseAll);

void inverseContinue(benchmark::State& state) {
    const Fixture& f = fixture();
    std::size_t n = 0;
    robot::Joints out;
    for (auto _ : state) {
        const std::size_t i = n++ & 1023;
        benchmark::DoNotOptimize(f.kinematics.inverseContinue(f.poses[i], f.joints[i], out));
        benchmark::DoNotOptimize(out);
    }
}
BENCHMARK(inverseContinue);

void jacobian(benchmark::State& state) {
    const Fixture& f = fixture();
    std::size_t n = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(f.kinematics.jacobian(f.joints[n++ & 1023]));
}
BENCHMARK(jacobian);

} // namespace

BENCHMARK_MAIN();
