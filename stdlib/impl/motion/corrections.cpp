// Manual 1.8: generators of path corrections. Their sum displaces the movements with \Corr (motion::PathCorrections).

#include "stdlib/impl/motion/corrections.h"
#include "runtime/motion/path_corrections.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/path.h"
#include "stdlib_constants.h"

#include <array>

using namespace rt;

namespace {

constexpr std::size_t kMost = 5;

struct Generator {
    Handle id = 0; ///< 0: free
    motion::Vec3 offset;
};

struct Corrections {
    std::array<Generator, kMost> generators{};
    Handle lastId = 0;
    std::shared_ptr<motion::PathCorrections> path; ///< null until a generator or \Corr is used

    /// Null when the descriptor is not connected.
    Generator* find(Handle id) {
        for (Generator& generator : generators)
            if (generator.id == id && id != 0) return &generator;
        return nullptr;
    }
};

motion::Vec3 sumOf(const Corrections& corrections) {
    motion::Vec3 sum;
    for (const Generator& generator : corrections.generators)
        sum = sum + generator.offset;
    return sum;
}

Corrections& correctionsOf(TaskCore* task) {
    return lib::motionOf(task).service<Corrections>();
}

motion::PathCorrections& onPathOf(MotionDriver& motion) {
    Corrections& corrections = motion.service<Corrections>();
    if (corrections.path == nullptr) {
        corrections.path = std::make_shared<motion::PathCorrections>();
        motion.system().addModifier(corrections.path);
    }
    return *corrections.path;
}

/// The sum has changed; what has been executed keeps the one before.
void apply(MotionDriver& motion) {
    motion.refresh();
    onPathOf(motion).setOffset(sumOf(motion.service<Corrections>()));
    motion.refresh();
}

Status notConnected(TaskCore* task) {
    return lib::fail(task, err::CORR_NOTCONN,
                     "the descriptor is not connected with a correction generator (CorrCon)");
}

} // namespace

namespace rt::lib {

void endCorrections(MotionDriver& motion) {
    Corrections& corrections = motion.service<Corrections>();
    corrections.generators = {};
    if (corrections.path != nullptr) apply(motion);
}

motion::MoveCommand corrected(TaskCore* task, motion::MoveCommand command, bool isCorrected) {
    if (isCorrected) command.modifications.push_back(onPathOf(motionOf(task)).modification());
    return command;
}

} // namespace rt::lib

extern "C" {

/// A descriptor that is connected already keeps its generator, which begins at 0 again.
Status rt_CorrCon(TaskCore* task, Handle* Descr) {
    Corrections& corrections = correctionsOf(task);
    if (Generator* known = corrections.find(*Descr)) {
        known->offset = {};
        apply(lib::motionOf(task));
        return kOk;
    }
    for (Generator& generator : corrections.generators) {
        if (generator.id != 0) continue;
        generator = {++corrections.lastId, {}};
        *Descr = generator.id;
        return kOk;
    }
    return lib::fail(task, err::CORR_NOFREE,
                     "all 5 correction generators are connected: use CorrDiscon first");
}

Status rt_CorrWrite(TaskCore* task, Handle* Descr, const data::Pos* Data) {
    Generator* generator = correctionsOf(task).find(*Descr);
    if (generator == nullptr) return notConnected(task);
    generator->offset = {Data->x, Data->y, Data->z};
    apply(lib::motionOf(task));
    return kOk;
}

Status rt_CorrRead(TaskCore* task, data::Pos* result) {
    *result = lib::toPos(sumOf(correctionsOf(task)));
    return kOk;
}

Status rt_CorrDiscon(TaskCore* task, Handle* Descr) {
    Generator* generator = correctionsOf(task).find(*Descr);
    if (generator == nullptr) return notConnected(task);
    *generator = {};
    apply(lib::motionOf(task));
    *Descr = 0;
    return kOk;
}

Status rt_CorrClear(TaskCore* task) {
    lib::endCorrections(lib::motionOf(task));
    return kOk;
}
}
