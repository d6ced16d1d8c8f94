// Speed of the kinematics, by mechanism. Aims with a spherical wrist: forward 80 ns, one branch by confdata 120 ns, all
// eight 350 ns. Offset wrist and seven axes: following 5 us, all branches 50 us.

#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kPostures = 1024;

/// Random postures of one arm inside its limits, and beside each a posture a tenth of a degree away to follow from.
struct Fixture {
    robot::Kinematics kinematics;
    std::vector<robot::Joints> joints, near;
    std::vector<robot::Pose> poses;
    std::vector<robot::ConfData> confs;
    std::vector<double> armAngles;

    explicit Fixture(const char* name) {
        auto model = robot::loadRobotModel(name);
        if (!model) std::abort();
        kinematics = robot::Kinematics(*model);
        std::mt19937_64 random(1);
        for (std::size_t n = 0; n < kPostures; ++n) {
            robot::Joints q = robot::Joints::zeros(kinematics.jointCount());
            robot::Joints beside = q;
            for (std::size_t i = 0; i < q.size(); ++i) {
                q[i] = std::uniform_real_distribution<double>(model->lowerDeg[i], model->upperDeg[i])(random);
                beside[i] = q[i] + ((n + i) % 2 == 0 ? 0.1 : -0.1);
            }
            joints.push_back(q);
            near.push_back(beside);
            poses.push_back(kinematics.forward(q));
            confs.push_back(kinematics.configuration(q));
            armAngles.push_back(kinematics.armAngle(q));
        }
    }
};

const Fixture& fixture(const char* name) {
    static std::map<std::string, Fixture> fixtures;
    return fixtures.try_emplace(name, name).first->second;
}

void forward(benchmark::State& state, const char* name) {
    const Fixture& f = fixture(name);
    std::size_t n = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(f.kinematics.forward(f.joints[n++ % kPostures]));
}

void inverseByConfiguration(benchmark::State& state, const char* name) {
    const Fixture& f = fixture(name);
    std::size_t n = 0;
    for (auto _ : state) {
        const std::size_t i = n++ % kPostures;
        benchmark::DoNotOptimize(f.kinematics.inverse(f.poses[i], f.confs[i], f.joints[i], f.armAngles[i]));
    }
}

void inverseAll(benchmark::State& state, const char* name) {
    const Fixture& f = fixture(name);
    const robot::Joints seed = robot::Joints::zeros(f.kinematics.jointCount()); // no help
    std::size_t n = 0;
    robot::IkBranches branches;
    for (auto _ : state) {
        const std::size_t i = n++ % kPostures;
        f.kinematics.inverseAll(f.poses[i], seed, branches, f.armAngles[i]);
        benchmark::DoNotOptimize(branches);
    }
}

void inverseContinue(benchmark::State& state, const char* name) {
    const Fixture& f = fixture(name);
    std::size_t n = 0;
    robot::Joints out;
    for (auto _ : state) {
        const std::size_t i = n++ % kPostures;
        benchmark::DoNotOptimize(f.kinematics.inverseContinue(f.poses[i], f.near[i], out, f.armAngles[i]));
        benchmark::DoNotOptimize(out);
    }
}

void jacobian(benchmark::State& state, const char* name) {
    const Fixture& f = fixture(name);
    std::size_t n = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(f.kinematics.jacobian(f.joints[n++ % kPostures]));
}

#define RAPID_MECHANISM(label, name)                                                                         \
    BENCHMARK_CAPTURE(forward, label, name);                                                                 \
    BENCHMARK_CAPTURE(inverseByConfiguration, label, name);                                                  \
    BENCHMARK_CAPTURE(inverseAll, label, name);                                                              \
    BENCHMARK_CAPTURE(inverseContinue, label, name);                                                         \
    BENCHMARK_CAPTURE(jacobian, label, name)

RAPID_MECHANISM(spherical_wrist, "IRB 2400-10/1.55");
RAPID_MECHANISM(offset_wrist, "CRB 15000-5/0.95");
RAPID_MECHANISM(seven_axes, "IRB 14050-0.5/0.559");
RAPID_MECHANISM(parallel_rods, "IRB 460-110/2.4");
RAPID_MECHANISM(scara, "IRB 910SC-3/0.65");
RAPID_MECHANISM(delta, "IRB 360-1/1600");

#undef RAPID_MECHANISM

} // namespace

BENCHMARK_MAIN();
