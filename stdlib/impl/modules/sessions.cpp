// Manual 1.6: StartLoad, WaitLoad, CancelLoad. The file is read when loading starts; the task continues meanwhile.

#include "stdlib/impl/modules/loading.h"
#include "stdlib/impl/support/fail.h"

#include "natives/various.h"
#include "stdlib_constants.h"

#include <deque>
#include <fmt/format.h>
#include <optional>
#include <unistd.h>

using namespace rt;

namespace {

struct Session {
    lib::ModuleFile file;
    bool dynamic = false;
    Time ready = 0;
    lib::ReadProblem problem; ///< raised by WaitLoad
    uint32_t task = 0;
};

/// A handle is the number of a place, from 1.
struct Sessions {
    std::deque<std::optional<Session>> places;

    std::optional<Session>* find(Handle handle) {
        if (handle < 1 || handle > static_cast<Handle>(places.size())) return nullptr;
        std::optional<Session>& place = places[static_cast<std::size_t>(handle - 1)];
        return place ? &place : nullptr;
    }
    Handle add(Session session) {
        std::size_t i = 0;
        while (i < places.size() && places[i])
            ++i;
        if (i == places.size()) places.emplace_back();
        places[i] = std::move(session);
        return static_cast<Handle>(i) + 1;
    }
};

Sessions& sessions(TaskCore* task) {
    return taskOf(task).controller().service<Sessions>();
}

Status notInUse(TaskCore* task) {
    return lib::fail(task, err::ERR_LOADNO_NOUSE, "the load session is not in use; StartLoad begins one");
}

} // namespace

extern "C" {

Status rt_StartLoad(TaskCore* task, bool Dynamic, const String* FilePath, const String* File,
                    Handle* LoadNo) {
    if (sessions(task).find(*LoadNo) != nullptr)
        return lib::fail(task, err::ERR_LOADNO_INUSE,
                         "the load session is in use; WaitLoad or CancelLoad ends what it loads");
    Session session;
    session.dynamic = Dynamic;
    session.task = taskOf(task).index();
    session.problem = lib::tryReadModule(task, *FilePath, File, session.file);
    if (session.problem.number == err::ERR_FILNOTFND)
        return lib::fail(task, session.problem.number, session.problem.text);
    session.ready = taskOf(task).now() + lib::loadingTime(session.file);
    *LoadNo = sessions(task).add(std::move(session));
    return kOk;
}

Status rt_WaitLoad(TaskCore* task, const String* UnloadPath, const String* UnloadFile, Handle* LoadNo,
                   bool CheckRef) {
    std::optional<Session>* place = sessions(task).find(*LoadNo);
    if (place == nullptr) return notInUse(task);
    const bool isLoading = taskOf(task).now() < (*place)->ready;
    if (const Status status = taskOf(task).sleepUntil((*place)->ready); status != kOk) return status;
    place = sessions(task).find(*LoadNo);
    if (place == nullptr) return notInUse(task); // another task cancelled it meanwhile
    if (UnloadPath != nullptr)
        if (const Status status = lib::unloadFile(task, *UnloadPath, UnloadFile); status != kOk)
            return status;
    const Session session = std::move(**place);
    place->reset();
    *LoadNo = 0;
    if (session.problem.number != kOk) return lib::fail(task, session.problem.number, session.problem.text);
    if (isLoading && ::access(session.file.path.c_str(), F_OK) != 0)
        return lib::fail(task, err::ERR_FILNOTFND, session.file.shown + " was removed while it was loaded");
    return lib::linkModule(task, session.file, session.dynamic, CheckRef);
}

Status rt_CancelLoad(TaskCore* task, Handle* LoadNo) {
    std::optional<Session>* place = sessions(task).find(*LoadNo);
    if (place == nullptr) return notInUse(task);
    place->reset();
    *LoadNo = 0;
    return kOk;
}
}
