// MotionSystem: several robots that move together (MultiMove, synchronised movements).

#include "runtime/motion/follower.h"
#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

/// The user frame that a robot, or an external unit of its group, moves.
std::function<Pose(const RoutePoint&)> frameOf(const MotionSystem& system, const robot::ExternalUnit* unit) {
    return [&system, unit](const RoutePoint& point) {
        return unit != nullptr ? unit->frame(point.extax) : system.flangeInWorld({point.joints, point.extax});
    };
}

/// That frame along the carrier's path.
std::shared_ptr<const std::function<Pose(double)>>
courseOf(const std::function<Pose(const RoutePoint&)>& frame, const std::shared_ptr<const MotionPath>& path) {
    return std::make_shared<const std::function<Pose(double)>>([frame, path](double share) {
        return frame({path->jointsAt(share), path->externalAt(share), true});
    });
}

} // namespace

bool MotionSystem::beginTogether(const std::vector<MotionSystem*>& systems) {
    const bool areResting = std::all_of(systems.begin(), systems.end(), [](const MotionSystem* system) {
        return system->impl_->isResting();
    });
    if (!areResting || systems.empty()) return false;
    std::vector<Impl::PathStart> starts;
    for (const MotionSystem* system : systems) {
        const Impl& s = *system->impl_;
        starts.push_back(
            {s.standing(), s.path().isEmpty() ? s.based({}) : s.path().framesAt(s.path().end())});
    }
    const auto paths = Impl::pathsTogether(systems, starts);
    for (std::size_t i = 0; i < systems.size(); ++i)
        systems[i]->impl_->beginPath(paths[i]);
    for (MotionSystem* system : systems)
        system->impl_->holdOrRelease();
    return true;
}

/// The first path leads, the others follow it.
std::vector<std::shared_ptr<Trajectory>>
MotionSystem::Impl::pathsTogether(const std::vector<MotionSystem*>& systems,
                                  const std::vector<PathStart>& starts) {
    const Impl& first = *systems.front()->impl_;
    const std::shared_ptr<Trajectory> leader = first.newPath(starts.front().axes, first.seconds());
    std::vector<std::shared_ptr<Trajectory>> paths{leader};
    for (std::size_t i = 1; i < systems.size(); ++i) {
        const Impl& s = *systems[i]->impl_;
        paths.push_back(std::make_shared<Follower>(leader, i - 1, s.model, s.options.external, starts[i].axes,
                                                   starts[i].frames));
        leader->addCompanion(paths.back());
    }
    return paths;
}

void MotionSystem::endTogether(const std::vector<MotionSystem*>& systems) {
    for (MotionSystem* system : systems) {
        Impl& s = *system->impl_;
        if (!s.isResting()) {
            if (!s.level.queue.empty()) s.noteCleared(s.level.queue.front()->id);
            s.level.queue.clear();
            s.abandonPath(StopKind::Normal);
            s.noteMotion();
            continue;
        }
        s.beginPath(s.newPath(s.standing(), s.seconds()));
        s.holdOrRelease();
    }
}

bool MotionSystem::areTogether(const std::vector<MotionSystem*>& systems) {
    const Trajectory* leader = systems.front()->impl_->level.path.get();
    for (std::size_t i = 1; i < systems.size(); ++i) {
        const auto* follower = dynamic_cast<const Follower*>(systems[i]->impl_->level.path.get());
        if (follower == nullptr || follower->leader() != leader) return false;
    }
    return true;
}

/// The movements as the planner knows them; nothing has been ordered yet.
Expected<std::vector<Trajectory::Ordered>, MotionSystem::TogetherError>
MotionSystem::Impl::preparedTogether(const std::vector<MotionSystem*>& systems,
                                     const std::vector<MoveCommand>& commands) {
    // A point where one of them stops is a stop point for all.
    const bool isFine =
        std::any_of(commands.begin(), commands.end(), [](const MoveCommand& c) { return c.zone.finep; });
    std::vector<Trajectory::Ordered> moves(systems.size());
    // Robots that carry a work object of another one come first.
    for (const bool areCarried : {false, true}) {
        for (std::size_t i = 0; i < systems.size(); ++i) {
            if ((commands[i].frames.carrier != nullptr) != areCarried) continue;
            MoveCommand command = commands[i];
            command.zone.finep = isFine;
            const auto carrier = std::find(systems.begin(), systems.end(), command.frames.carrier);
            std::function<Pose(const RoutePoint&)> frame;
            if (areCarried && carrier != systems.end()) {
                const auto number = static_cast<std::size_t>(carrier - systems.begin());
                if (commands[number].frames.carrier != nullptr) {
                    MotionError error;
                    error.what = "a work object held by a robot whose own work object is held by another one";
                    return Unexpected{TogetherError{i, error}};
                }
                frame = frameOf(**carrier, command.frames.carrierUnit);
                command.frames.userCourse = courseOf(frame, moves[number].path);
            }
            auto ordered = systems[i]->impl_->prepared(command);
            if (!ordered) return Unexpected{TogetherError{i, ordered.error()}};
            moves[i] = std::move(*ordered);
            if (!frame) continue;
            moves[i].carrier = static_cast<std::size_t>(carrier - systems.begin());
            moves[i].carrierFrame = std::move(frame);
        }
    }
    return moves;
}

Expected<std::vector<MoveId>, MotionSystem::TogetherError>
MotionSystem::enqueueTogether(const std::vector<MotionSystem*>& systems,
                              const std::vector<MoveCommand>& commands) {
    const auto moves = Impl::preparedTogether(systems, commands);
    if (!moves) return Unexpected{moves.error()};
    Impl& first = *systems.front()->impl_;
    const Trajectory::Appended appended = first.path().appendTogether(*moves, first.seconds());
    std::vector<MoveId> ids;
    for (std::size_t i = 0; i < systems.size(); ++i)
        ids.push_back(systems[i]->impl_->registerMove((*moves)[i].command, appended));
    return ids;
}

} // namespace motion
