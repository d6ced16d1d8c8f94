// Manual 1.6: Save.

#include "runtime/host/controller.h"
#include "runtime/host/module_saver.h"
#include "stdlib/impl/support/fail.h"

#include "natives/various.h"
#include "stdlib_constants.h"

#include <filesystem>

using namespace rt;

namespace {

std::string_view textOf(const String* text) {
    return text != nullptr ? text->view() : std::string_view();
}

} // namespace

extern "C" {

Status rt_Save(TaskCore* task, Handle* TaskRef, const String* TaskName, const String* ModuleName,
               const String* FilePath, const String* File) {
    Controller& controller = taskOf(task).controller();
    const Task* owner = &taskOf(task);
    if (TaskName != nullptr) owner = controller.findTask(TaskName->view());
    if (TaskRef != nullptr) {
        const auto number = static_cast<std::size_t>(*TaskRef);
        owner = number >= 1 && number <= controller.tasks().size() ? controller.tasks()[number - 1].get()
                                                                   : nullptr;
    }
    if (owner == nullptr)
        return lib::fail(task, err::ERR_TASKNAME,
                         "Save: there is no task '" + std::string(textOf(TaskName)) + "'");
    std::string destination;
    if (FilePath != nullptr || File != nullptr) {
        if (!controller.volumes().resolve(textOf(FilePath), textOf(File), destination))
            return lib::fail(
                task, err::ERR_FILEACC,
                "Save: the path leaves its volume, or names a device that the controller does not have");
        std::error_code ignored;
        if (std::filesystem::is_directory(destination, ignored))
            return lib::fail(task, err::ERR_PATH,
                             "Save: the path names a folder; give the file name, too (\\File)");
    }
    const ModuleSaver::Result result = controller.saver().save(*owner, ModuleName->view(), destination);
    switch (result.outcome) {
    case ModuleSaver::Outcome::Saved: return kOk;
    case ModuleSaver::Outcome::NoModule: return lib::fail(task, err::ERR_MODULE, "Save: " + result.text);
    case ModuleSaver::Outcome::NotWritten: break;
    }
    return lib::fail(task, err::ERR_IOERROR, "Save: " + result.text);
}
}
