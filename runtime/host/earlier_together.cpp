// MotionDriver: what remains of a synchronised movement, between two processes (--state).

#include "runtime/host/motion_driver.h"
#include "runtime/host/synchronised_group.h"

#include <algorithm>
#include <set>
#include <utility>

namespace rt {

/// The rest of one robot's movement that all make together.
struct MotionDriver::EarlierOrders {
    MotionDriver* driver = nullptr;
    std::vector<motion::MoveCommand> moves;
    std::optional<motion::MoveCommand> awaited; ///< by the instruction that is executed again
};

namespace {

using Idents = std::set<int64_t>;

/// Those that every robot has left: one that only some of them have passed is over.
template <class Orders> Idents commonIdents(const std::vector<Orders>& all) {
    Idents common;
    bool isFirst = true;
    for (const Orders& one : all) {
        Idents own;
        for (const motion::MoveCommand& move : one.moves)
            own.insert(move.ident);
        if (one.awaited) own.insert(one.awaited->ident);
        if (std::exchange(isFirst, false))
            common = own;
        else
            std::erase_if(common, [&](int64_t ident) { return own.count(ident) == 0; });
    }
    return common;
}

using Places = std::vector<MotionDriver::EarlierPlace>;

/// All of them are on a movement, or all in the zone between two.
bool areAlike(const Places& places, std::size_t robots) {
    return places.size() == robots && std::all_of(places.begin(), places.end(), [&](const auto& place) {
               return place.before.has_value() == places.front().before.has_value();
           });
}

} // namespace

motion::Expected<std::vector<motion::MoveId>, motion::MotionSystem::TogetherError>
MotionDriver::orderTogether(const SynchronisedGroup& group, const std::vector<const Task*>& tasks,
                            std::vector<motion::MoveCommand>& commands) {
    const auto systems = group.systems();
    using Ids = std::vector<motion::MoveId>;
    if (!motion::MotionSystem::areTogether(systems) && !motion::MotionSystem::beginTogether(systems))
        return Ids();
    const auto& members = group.members();
    std::vector<Beginning> beginnings;
    for (std::size_t i = 0; i < members.size(); ++i)
        beginnings.push_back(members[i].driver->beginOrder(tasks[i], commands[i]));
    const auto underWay = continueUnderWay(group, tasks, commands, beginnings);
    motion::Expected<Ids, motion::MotionSystem::TogetherError> ordered =
        underWay ? *underWay : motion::MotionSystem::enqueueTogether(systems, commands);
    for (std::size_t i = 0; i < members.size() && ordered; ++i)
        members[i].driver->noteOrdered(tasks[i], commands[i], (*ordered)[i], beginnings[i]);
    return ordered;
}

/// The robots, about to make these movements, continue on the path that an earlier process left; nothing when it did not, or when
/// they are elsewhere: then what is left before these movements has been ordered.
std::optional<std::vector<motion::MoveId>>
MotionDriver::continueUnderWay(const SynchronisedGroup& group, const std::vector<const Task*>& tasks,
                               std::vector<motion::MoveCommand>& commands,
                               std::vector<Beginning>& beginnings) {
    const auto& members = group.members();
    Places places;
    for (const SynchronisedGroup::Member& member : members)
        if (auto place = std::exchange(member.driver->earlier_.place, {})) places.push_back(*place);
    if (places.empty()) return {};
    const bool areAll = areAlike(places, members.size());
    std::optional<std::vector<motion::MotionSystem::OrderedUnderWay>> ordered;
    if (areAll) {
        std::vector<motion::MotionSystem::UnderWay> orders;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const uint64_t latest = members[i].driver->instructions_;
            if (places[i].before) places[i].before->tag = latest + 1;
            commands[i].tag = latest + (places[i].before ? 2 : 1);
            orders.push_back({places[i].from, places[i].before, commands[i]});
        }
        ordered =
            motion::MotionSystem::enqueueTogetherUnderWay(group.systems(), orders, places.front().covered);
    }
    if (!ordered && areAll && places.front().before && !places.front().isPassed) {
        std::vector<motion::MoveCommand> before;
        for (std::size_t i = 0; i < members.size(); ++i) {
            before.push_back(*places[i].before);
            members[i].driver->continueEarlier(before.back());
        }
        (void)orderTogether(group, std::vector<const Task*>(members.size()), before);
    }
    std::vector<motion::MoveId> ids;
    for (std::size_t i = 0; i < members.size(); ++i) {
        MotionDriver& driver = *members[i].driver;
        if (ordered) {
            beginnings[i] = driver.takeUnderWay(places[i], (*ordered)[i], commands[i]);
            ids.push_back((*ordered)[i].move);
            continue;
        }
        driver.continueEarlier(commands[i]); // from where the arm is
        beginnings[i] = driver.beginOrder(tasks[i], commands[i]);
    }
    if (!ordered) return {};
    return ids;
}

/// Movements that all robots have ordered begin now. At one that some robot orders again (its instruction waited for it), the
/// others' orders wait for that.
void MotionDriver::orderEarlierTogether(SynchronisedGroup& group, const std::vector<EarlierOrders>& orders) {
    const Idents common = commonIdents(orders);
    std::vector<std::vector<motion::MoveCommand>> left;
    std::size_t complete = common.size();
    for (const EarlierOrders& one : orders) {
        auto& moves = left.emplace_back();
        for (const motion::MoveCommand& move : one.moves)
            if (common.count(move.ident) != 0) moves.push_back(move);
        complete = std::min(complete, moves.size());
    }
    // In a zone the movement before it is ordered with the one after it.
    const auto& place = orders.front().driver->earlier_.place;
    const auto& moves = left.front();
    const bool hasBefore =
        place && place->before && !moves.empty() && moves.front().ident == place->before->ident;
    const std::size_t first = hasBefore ? 1 : 0;
    for (std::size_t k = first; k < complete; ++k) {
        std::vector<motion::MoveCommand> commands;
        for (std::size_t i = 0; i < orders.size(); ++i) {
            orders[i].driver->continueEarlier(left[i][k]);
            commands.push_back(left[i][k]);
        }
        const auto ids = orderTogether(group, std::vector<const Task*>(orders.size()), commands);
        if (!ids || ids->empty()) return; // the program orders what comes next
    }
    for (std::size_t i = 0; i < orders.size(); ++i) {
        for (std::size_t k = std::max(first, complete); k < left[i].size(); ++k) {
            orders[i].driver->continueEarlier(left[i][k]);
            group.expect(*orders[i].driver, left[i][k]);
        }
    }
}

void MotionDriver::continueTogether(SynchronisedGroup& group, std::vector<EarlierPath> paths) {
    const auto& members = group.members();
    std::size_t levels = 0;
    for (const EarlierPath& path : paths)
        levels = std::max(levels, path.stored.size() + 1);
    for (std::size_t level = 0; level < levels; ++level) {
        const auto isShared = [level](const EarlierPath& path) {
            if (level > path.stored.size()) return false;
            return !(level < path.stored.size() ? path.stored[level].isSuspended : path.isSuspended);
        };
        const auto isStored = [level](const EarlierPath& path) { return level < path.stored.size(); };
        const bool areTogether = std::all_of(paths.begin(), paths.end(), isShared);
        const bool isAside = std::any_of(paths.begin(), paths.end(), isStored);
        std::vector<EarlierOrders> orders;
        std::vector<motion::JointTarget> here;
        for (std::size_t i = 0; i < members.size(); ++i) {
            MotionDriver& driver = *members[i].driver;
            here.push_back(driver.system_.currentJoints());
            driver.earlier_ = {};
            if (!areTogether) continue;
            if (isStored(paths[i])) driver.system_.placeAt(paths[i].stored[level].left);
            if (isAside) driver.system_.stop();
            driver.earlier_.begun = isStored(paths[i]) ? paths[i].stored[level].begun : paths[i].begun;
            driver.earlier_.place = isStored(paths[i]) ? paths[i].stored[level].place : paths[i].place;
            orders.push_back({&driver, isStored(paths[i]) ? paths[i].stored[level].moves : paths[i].moves,
                              isStored(paths[i]) ? std::nullopt : paths[i].awaited});
        }
        if (areTogether) orderEarlierTogether(group, orders);
        for (std::size_t i = 0; i < members.size(); ++i)
            members[i].driver->finishEarlierLevel(paths[i], level, areTogether, here[i]);
    }
}

/// Puts the level aside as it was, or continues with it when it is the present one.
void MotionDriver::finishEarlierLevel(const EarlierPath& path, std::size_t number, bool isOrdered,
                                      const motion::JointTarget& here) {
    if (number > path.stored.size()) return;
    if (number == path.stored.size()) {
        if (!isOrdered) {
            earlier_.begun = path.begun;
            earlier_.place = path.place;
            orderRest(path.moves, path.awaited.has_value());
        }
        return holdEarlier(path);
    }
    const EarlierLevel& level = path.stored[number];
    if (!isOrdered) return storeEarlier(level);
    system_.storePath();
    system_.placeAt(here);
    levels_.push_back({level.stopMove, {}, level.left, level.isSuspended, level.place});
}

} // namespace rt
