#include "runtime/motion/profile_terms.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace motion {

namespace {

using Quad = ProfileTerms::Quad;
using Three = ProfileTerms::Three;
using Data = ProfileTerms::Data;
using Slot = ProfileTerms::Slot;
using End = ProfileTerms::End;
using Block = ProfileTerms::Block;

constexpr std::size_t kLanes = ProfileTerms::kLanes;

// These functions are compiled twice, for any processor and for vectors of four numbers. The operations and their order are
// the same, and so is the result. Vectors are handed over by reference: how values are, depends on the processor.
#define RAPIDC_INLINE [[gnu::always_inline]] inline

RAPIDC_INLINE void load(Quad& to, const double* from) {
    std::memcpy(&to, from, sizeof to);
}

RAPIDC_INLINE void loadThree(std::array<Quad, 3>& to, const double* from) {
    for (std::size_t k = 0; k < 3; ++k)
        load(to[k], from + k);
}

RAPIDC_INLINE void rootOf(Quad& value) {
#if defined(__clang__)
    value = __builtin_elementwise_sqrt(value);
#else
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        value[lane] = std::sqrt(value[lane]);
#endif
}

RAPIDC_INLINE void raise(Quad& most, const Quad& value) {
    most = value > most ? value : most;
}

RAPIDC_INLINE void dot(Quad& result, const std::array<Quad, 3>& a, const std::array<Quad, 3>& b) {
    result = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RAPIDC_INLINE double sumOf(const Quad& quad) {
    return (quad[0] + quad[1]) + (quad[2] + quad[3]);
}

RAPIDC_INLINE double mostOf(const Quad& quad) {
    return std::max(std::max(quad[0], quad[1]), std::max(quad[2], quad[3]));
}

/// Contribution of a block to the rows of the three coefficients of its cells, and the common part of its jerks.
struct Sums {
    std::array<Quad, 3> diagonal{}, right{}, cross{};
    std::array<Quad, 2> next{};
    Quad second{}, both{}, push{};
};

/// Both limits of a row: takes the last step, and adds to the sums. The gradients are row and -row, of jerks also fall * square.
template <bool kIsJerk>
RAPIDC_INLINE void addSlot(Sums& sums, Slot& slot, const std::array<Quad, 3>& c, const Quad* limits,
                           const ProfileTerms::Lengths& lengths, double target) {
    Quad value;
    dot(value, slot.row, c);
    std::array<Quad, 2> ratio, pull;
    for (std::size_t side = 0; side < 2; ++side) {
        const Quad& limit = limits[kIsJerk ? 0 : side];
        const Quad slack = slot.slack[side] + lengths.speeds * slot.slackStep[side];
        const Quad force = slot.force[side] + lengths.forces * slot.forceStep[side];
        const Quad inverse = 1.0 / slack;
        const Quad miss = (side == 0 ? value : -value) - limit + slack;
        ratio[side] = force * inverse;
        pull[side] = target * inverse * slot.used + ratio[side] * miss;
        slot.slack[side] = slack;
        slot.force[side] = force;
        slot.inverse[side] = inverse;
        slot.miss[side] = miss;
    }
    const Quad both = ratio[0] + ratio[1];
    const Quad odd = pull[0] - pull[1];
    std::array<Quad, 3> even;
    for (std::size_t k = 0; k < 3; ++k) {
        even[k] = both * slot.row[k];
        sums.diagonal[k] += even[k] * slot.row[k];
        sums.right[k] += odd * slot.row[k];
    }
    sums.next[0] += even[0] * slot.row[1];
    sums.next[1] += even[1] * slot.row[2];
    sums.second += even[0] * slot.row[2];
    if constexpr (kIsJerk) {
        const Quad difference = ratio[0] - ratio[1];
        for (std::size_t k = 0; k < 3; ++k)
            sums.cross[k] += difference * slot.row[k];
        sums.both += both;
        sums.push += pull[0] + pull[1];
    }
}

RAPIDC_INLINE void evaluateEnd(End& end, const std::array<Quad, 3>& c) {
    Quad square;
    dot(square, end.square, c);
    const Quad least = {1e-12, 1e-12, 1e-12, 1e-12};
    raise(square, least);
    Quad root = square;
    rootOf(root);
    const Quad inverse = 1.0 / (root * square);
    end.fall = 0.5 * end.bound * inverse;
    end.limit = end.bound * square * inverse;
}

/// The parts of the matrix that all jerks at an end have in common.
RAPIDC_INLINE void addFall(Sums& sums, const End& end) {
    std::array<Quad, 3> q, part;
    for (std::size_t k = 0; k < 3; ++k) {
        q[k] = end.fall * end.square[k];
        part[k] = sums.cross[k] + sums.both * q[k];
        sums.right[k] += sums.push * q[k];
        sums.diagonal[k] += (sums.cross[k] + part[k]) * q[k];
    }
    sums.next[0] += part[0] * q[1] + q[0] * sums.cross[1];
    sums.next[1] += part[1] * q[2] + q[1] * sums.cross[2];
    sums.second += part[0] * q[2] + q[0] * sums.cross[2];
    sums.cross = {};
    sums.both = sums.push = Quad{};
}

/// Without its terms: the duration and the largest coefficients.
RAPIDC_INLINE void assembleCaps(Data& data, const double* c, ProfileMatrix& matrix) {
    for (std::size_t i = 0; i < data.caps.size(); ++i) {
        ProfileTerms::Caps& caps = data.caps[i];
        Quad x;
        load(x, c + kLanes * i);
        caps.slack += data.lengths.speeds * caps.slackStep;
        caps.force += data.lengths.forces * caps.forceStep;
        caps.inverse = 1.0 / caps.slack;
        caps.miss = x - caps.cap + caps.slack;
        Quad root = x;
        rootOf(root);
        const Quad slope = caps.weight / (x * x * root);
        const Quad ratio = caps.force * caps.inverse;
        const Quad diagonal = caps.free * (0.75 * slope + ratio);
        const Quad right = caps.free * (0.5 * slope * x - data.target * caps.inverse - ratio * caps.miss);
        std::memcpy(&matrix.diagonal[kLanes * i], &diagonal, sizeof diagonal);
        std::memcpy(&matrix.right[kLanes * i], &right, sizeof right);
    }
}

RAPIDC_INLINE void assembleAll(Data& data, const double* c, ProfileMatrix& matrix) {
    assembleCaps(data, c, matrix);
    std::fill(matrix.next.begin(), matrix.next.end(), 0.0);
    std::fill(matrix.second.begin(), matrix.second.end(), 0.0);
    const ProfileTerms::Lengths lengths = data.lengths;
    const double target = data.target;
    for (std::size_t b = 0; b < data.blocks.size(); ++b) {
        Block& block = data.blocks[b];
        const std::size_t at = kLanes * b;
        std::array<Quad, 3> here;
        loadThree(here, c + at);
        Sums sums;
        for (std::size_t i = 0; i < block.accelerations.count; ++i) {
            Slot& slot = data.accelerations[block.accelerations.begin + i];
            addSlot<false>(sums, slot, here, slot.most.data(), lengths, target);
        }
        for (std::size_t e = 0; e < 2; ++e) {
            End& end = block.ends[e];
            if (block.jerks[e].count == 0) continue;
            evaluateEnd(end, here);
            for (std::size_t i = 0; i < block.jerks[e].count; ++i)
                addSlot<true>(sums, data.jerks[e][block.jerks[e].begin + i], here, &end.limit, lengths,
                              target);
            addFall(sums, end);
        }
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            for (std::size_t k = 0; k < 3; ++k) {
                matrix.diagonal[at + lane + k] += sums.diagonal[k][lane];
                matrix.right[at + lane + k] -= sums.right[k][lane];
            }
            matrix.next[at + lane] += sums.next[0][lane];
            matrix.next[at + lane + 1] += sums.next[1][lane];
            matrix.second[at + lane] += sums.second[lane];
        }
    }
}

/// Largest shares that a step takes of slacks and of forces, and what it changes of their products.
struct Steps {
    Quad slackLoss{}, forceLoss{};
    Quad bySlack{}, byBoth{};
};

/// Divides only where the loss is larger than the largest one so far.
RAPIDC_INLINE void raiseShare(Quad& most, const Quad& loss, const Quad& whole) {
    const auto isMore = loss > most * whole;
    if ((isMore[0] | isMore[1] | isMore[2] | isMore[3]) == 0) return;
    raise(most, loss / whole);
}

RAPIDC_INLINE void stepPair(Steps& steps, const Quad& force, const Quad& inverse, const Quad& slackStep,
                            Quad& forceStep, const Quad& target) {
    forceStep = (target - force * slackStep) * inverse - force;
    raise(steps.slackLoss, -slackStep * inverse);
    raiseShare(steps.forceLoss, -forceStep, force);
    steps.bySlack += slackStep * force;
    steps.byBoth += slackStep * forceStep;
}

RAPIDC_INLINE void stepSlot(Steps& steps, Slot& slot, const std::array<Quad, 3>& step, const Quad& fall,
                            double target) {
    Quad along;
    dot(along, slot.row, step);
    const Quad goal = target * slot.used;
    for (std::size_t side = 0; side < 2; ++side) {
        slot.slackStep[side] = slot.used * (-slot.miss[side] - (side == 0 ? fall + along : fall - along));
        stepPair(steps, slot.force[side], slot.inverse[side], slot.slackStep[side], slot.forceStep[side],
                 goal);
    }
}

RAPIDC_INLINE void stepAll(Data& data, const double* c, const double* step, Steps& steps) {
    for (std::size_t i = 0; i < data.caps.size(); ++i) {
        ProfileTerms::Caps& caps = data.caps[i];
        Quad x, change;
        load(x, c + kLanes * i);
        load(change, step + kLanes * i);
        raiseShare(steps.slackLoss, -change * caps.free, x);
        caps.slackStep = caps.free * (-caps.miss - change);
        const Quad goal = data.target * caps.free;
        stepPair(steps, caps.force, caps.inverse, caps.slackStep, caps.forceStep, goal);
    }
    for (std::size_t b = 0; b < data.blocks.size(); ++b) {
        const Block& block = data.blocks[b];
        std::array<Quad, 3> here;
        loadThree(here, step + kLanes * b);
        const Quad none{};
        for (std::size_t i = 0; i < block.accelerations.count; ++i)
            stepSlot(steps, data.accelerations[block.accelerations.begin + i], here, none, data.target);
        for (std::size_t e = 0; e < 2; ++e) {
            Quad fall;
            dot(fall, block.ends[e].square, here);
            fall *= block.ends[e].fall;
            for (std::size_t i = 0; i < block.jerks[e].count; ++i)
                stepSlot(steps, data.jerks[e][block.jerks[e].begin + i], here, fall, data.target);
        }
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void assembleWide(Data& data, const double* c, ProfileMatrix& matrix) {
    assembleAll(data, c, matrix);
}
[[gnu::target("avx2")]] void stepWide(Data& data, const double* c, const double* step, Steps& steps) {
    stepAll(data, c, step, steps);
}
bool isWide() {
    static const bool is = __builtin_cpu_supports("avx2") != 0;
    return is;
}
#else
void assembleWide(Data&, const double*, ProfileMatrix&) {}
void stepWide(Data&, const double*, const double*, Steps&) {}
constexpr bool isWide() {
    return false;
}
#endif

void assembleNarrow(Data& data, const double* c, ProfileMatrix& matrix) {
    assembleAll(data, c, matrix);
}
void stepNarrow(Data& data, const double* c, const double* step, Steps& steps) {
    stepAll(data, c, step, steps);
}

/// Calls visit(slot, coefficients there, limits up and down) for all slots of terms.
template <class DataOf, class Visit> void forEachSlot(DataOf& data, const double* c, const Visit& visit) {
    for (std::size_t b = 0; b < data.blocks.size(); ++b) {
        auto& block = data.blocks[b];
        std::array<Quad, 3> here;
        loadThree(here, c + kLanes * b);
        for (std::size_t i = 0; i < block.accelerations.count; ++i) {
            auto& slot = data.accelerations[block.accelerations.begin + i];
            visit(slot, here, slot.most);
        }
        for (std::size_t e = 0; e < 2; ++e) {
            End end = block.ends[e];
            if (block.jerks[e].count > 0) evaluateEnd(end, here);
            for (std::size_t i = 0; i < block.jerks[e].count; ++i)
                visit(data.jerks[e][block.jerks[e].begin + i], here,
                      std::array<Quad, 2>{end.limit, end.limit});
        }
    }
}

} // namespace

// ---- What is limited ----

void ProfileTerms::reset(const std::vector<double>& caps, const std::vector<double>& weights,
                         const std::vector<char>& isFixed) {
    data_.accelerations.clear();
    for (auto& slots : data_.jerks)
        slots.clear();
    data_.blocks.assign((caps.size() + 1) / kLanes, {});
    data_.caps.assign(data_.blocks.size() + 1, {});
    data_.lengths = {};
    for (Caps& c : data_.caps)
        c.cap = c.slack = Quad{1, 1, 1, 1};
    for (Block& block : data_.blocks)
        for (End& end : block.ends)
            end.bound = Quad{1, 1, 1, 1};
    fixed_.clear();
    for (std::size_t i = 0; i < caps.size(); ++i) {
        Caps& c = data_.caps[i / kLanes];
        c.cap[i % kLanes] = caps[i];
        c.weight[i % kLanes] = weights[i];
        c.free[i % kLanes] = isFixed[i] != 0 ? 0 : 1;
        if (isFixed[i] != 0) fixed_.push_back(i);
    }
    pairs_ = caps.size();
    used_ = {};
    cell_ = 0;
}

/// The next free slot for a row of a cell.
ProfileTerms::Slot& ProfileTerms::slotFor(std::vector<Slot>& slots, Range& range, std::size_t& used,
                                          std::size_t cell) {
    if (cell != cell_) used_ = {};
    cell_ = cell;
    if (range.count == 0) range.begin = slots.size();
    if (used == range.count) {
        slots.emplace_back();
        slots.back().most.fill(Quad{1, 1, 1, 1});
        ++range.count;
    }
    Slot& slot = slots[range.begin + used++];
    slot.used[cell % kLanes] = 1;
    pairs_ += 2;
    return slot;
}

void ProfileTerms::addAcceleration(std::size_t cell, const Three& row, double up, double down) {
    Slot& slot = slotFor(data_.accelerations, data_.blocks[cell / kLanes].accelerations, used_[0], cell);
    for (std::size_t k = 0; k < 3; ++k)
        slot.row[k][cell % kLanes] = row[k];
    slot.most[0][cell % kLanes] = up;
    slot.most[1][cell % kLanes] = down;
}

void ProfileTerms::setEnd(std::size_t cell, bool isLast, const Three& square, double bound) {
    End& end = data_.blocks[cell / kLanes].ends[isLast ? 1 : 0];
    for (std::size_t k = 0; k < 3; ++k)
        end.square[k][cell % kLanes] = square[k];
    end.bound[cell % kLanes] = bound;
}

void ProfileTerms::addJerk(std::size_t cell, bool isLast, const Three& row) {
    const std::size_t e = isLast ? 1 : 0;
    Slot& slot = slotFor(data_.jerks[e], data_.blocks[cell / kLanes].jerks[e], used_[1 + e], cell);
    for (std::size_t k = 0; k < 3; ++k)
        slot.row[k][cell % kLanes] = row[k];
}

// ---- Steps ----

void ProfileTerms::begin(const double* coefficients, double duration) {
    constexpr double kLeastSlack = 0.02; // of the largest coefficient
    const double target = 0.5 * duration / static_cast<double>(pairs_);
    Quad products{};
    for (std::size_t i = 0; i < data_.caps.size(); ++i) {
        Caps& caps = data_.caps[i];
        Quad x;
        load(x, coefficients + kLanes * i);
        caps.slack = caps.cap - x;
        raise(caps.slack, kLeastSlack * caps.cap);
        caps.force = caps.free * target / caps.slack;
        products += caps.slack * caps.force;
    }
    forEachSlot(data_, coefficients,
                [&](Slot& slot, const std::array<Quad, 3>& here, const std::array<Quad, 2>& limits) {
                    Quad value;
                    dot(value, slot.row, here);
                    for (std::size_t side = 0; side < 2; ++side) {
                        const Quad excess = (side == 0 ? value : -value) - limits[side];
                        Quad& slack = slot.slack[side];
                        slack = Quad{0.1, 0.1, 0.1, 0.1};
                        raise(slack, excess);
                        raise(slack, -excess);
                        slot.force[side] = slot.used * target / slack;
                        products += slack * slot.force[side];
                    }
                });
    gap_ = sumOf(products);
}

double ProfileTerms::duration(const double* coefficients) const {
    Quad sum{};
    for (std::size_t i = 0; i < data_.caps.size(); ++i) {
        Quad root;
        load(root, coefficients + kLanes * i);
        rootOf(root);
        sum += data_.caps[i].weight / root;
    }
    return sumOf(sum);
}

void ProfileTerms::assemble(const double* coefficients, double target, ProfileMatrix& matrix) {
    data_.target = target;
    (isWide() ? assembleWide : assembleNarrow)(data_, coefficients, matrix);
    data_.lengths = {};
    for (const std::size_t i : fixed_) {
        matrix.diagonal[i] = 1;
        matrix.right[i] = matrix.next[i] = matrix.second[i] = 0;
        if (i > 0) matrix.next[i - 1] = 0;
        if (i > 1) matrix.second[i - 2] = 0;
    }
}

ProfileTerms::Lengths ProfileTerms::stepLengths(const double* coefficients, const double* step) {
    constexpr double kToBorder = 0.97;
    Steps steps;
    (isWide() ? stepWide : stepNarrow)(data_, coefficients, step, steps);
    // Slack * step of the force is the target less force * (slack + step of the slack).
    const auto limits = static_cast<double>(pairs_ - fixed_.size());
    const double bySlack = sumOf(steps.bySlack);
    change_ = {bySlack, limits * data_.target - bySlack - gap_, sumOf(steps.byBoth)};
    const auto most = [](const Quad& loss) {
        return std::min(1.0, kToBorder / std::max(mostOf(loss), 1e-300));
    };
    return {most(steps.slackLoss), most(steps.forceLoss)};
}

void ProfileTerms::advance(const Lengths& lengths) {
    data_.lengths = lengths;
    gap_ += lengths.speeds * change_[0] + lengths.forces * change_[1] +
            lengths.speeds * lengths.forces * change_[2];
}

// ---- How good the result is ----

double ProfileTerms::imbalance(const double* coefficients) {
    const std::size_t count = kLanes * data_.caps.size();
    pull_.assign(count, 0);
    for (std::size_t b = 0; b < data_.blocks.size(); ++b) {
        const Block& block = data_.blocks[b];
        std::array<Quad, 3> sums{};
        const auto add = [&](const Slot& slot) {
            const Quad odd = slot.force[0] - slot.force[1];
            for (std::size_t k = 0; k < 3; ++k)
                sums[k] += odd * slot.row[k];
        };
        for (std::size_t i = 0; i < block.accelerations.count; ++i)
            add(data_.accelerations[block.accelerations.begin + i]);
        for (std::size_t e = 0; e < 2; ++e) {
            Quad even{};
            for (std::size_t i = 0; i < block.jerks[e].count; ++i) {
                const Slot& slot = data_.jerks[e][block.jerks[e].begin + i];
                add(slot);
                even += block.ends[e].fall * (slot.force[0] + slot.force[1]);
            }
            for (std::size_t k = 0; k < 3; ++k)
                sums[k] += even * block.ends[e].square[k];
        }
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            for (std::size_t k = 0; k < 3; ++k)
                pull_[kLanes * b + lane + k] += sums[k][lane];
    }
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Caps& caps = data_.caps[i / kLanes];
        const std::size_t lane = i % kLanes;
        const double c = coefficients[i];
        const double pull = pull_[i] + caps.force[lane] - 0.5 * caps.weight[lane] / (c * std::sqrt(c));
        sum += caps.free[lane] * std::abs(pull) * c;
    }
    return sum;
}

double ProfileTerms::worstExcess(const double* coefficients) const {
    Quad worst = {-1, -1, -1, -1};
    for (std::size_t i = 0; i < data_.caps.size(); ++i) {
        const Caps& caps = data_.caps[i];
        Quad x;
        load(x, coefficients + kLanes * i);
        raise(worst, caps.free * ((x - caps.cap) / caps.cap) - kMargin / 2);
    }
    forEachSlot(data_, coefficients,
                [&](const Slot& slot, const std::array<Quad, 3>& here, const std::array<Quad, 2>& limits) {
                    Quad value;
                    dot(value, slot.row, here);
                    raise(worst, (value - limits[0]) / limits[0] - kMargin / 2);
                    raise(worst, (-value - limits[1]) / limits[1] - kMargin / 2);
                });
    return mostOf(worst);
}

} // namespace motion
