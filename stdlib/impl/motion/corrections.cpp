// Manual 1.8: generators of path corrections. Values are kept and added up for CorrRead; movements with \Corr are not
// displaced by them.

#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

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

    /// Null when the descriptor is not connected.
    Generator* find(Handle id) {
        for (Generator& generator : generators)
            if (generator.id == id && id != 0) return &generator;
        return nullptr;
    }
};

Corrections& correctionsOf(TaskCore* task) {
    return lib::motionOf(task).service<Corrections>();
}

Status notConnected(TaskCore* task) {
    return lib::fail(task, err::CORR_NOTCONN,
                     "the descriptor is not connected with a correction generator (CorrCon)");
}

} // namespace

namespace rt::lib {

void endCorrections(MotionDriver& motion) {
    motion.service<Corrections>().generators = {};
}

} // namespace rt::lib

extern "C" {

/// A descriptor that is connected already keeps its generator, which begins at 0 again.
Status rt_CorrCon(TaskCore* task, Handle* Descr) {
    Corrections& corrections = correctionsOf(task);
    if (Generator* known = corrections.find(*Descr)) {
        known->offset = {};
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
    return kOk;
}

Status rt_CorrRead(TaskCore* task, data::Pos* result) {
    motion::Vec3 sum;
    for (const Generator& generator : correctionsOf(task).generators)
        sum = sum + generator.offset;
    *result = lib::toPos(sum);
    return kOk;
}

Status rt_CorrDiscon(TaskCore* task, Handle* Descr) {
    Generator* generator = correctionsOf(task).find(*Descr);
    if (generator == nullptr) return notConnected(task);
    *generator = {};
    *Descr = 0;
    return kOk;
}

Status rt_CorrClear(TaskCore* task) {
    lib::endCorrections(lib::motionOf(task));
    return kOk;
}
}
