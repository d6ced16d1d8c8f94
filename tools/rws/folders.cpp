#include "tools/rws/folders.h"

namespace rapidc::rws {

namespace {

struct Folder {
    const char* path;
    std::vector<const char*> names;
};

} // namespace

void addFolders(Router& router) {
    const Folder folders[] = {
        {"/", {"rw", "ctrl", "fileservice", "subscription", "users"}},
        {"/rw",
         {"cfg", "dipc", "elog", "iosystem", "mastership", "motionsystem", "panel", "rapid", "retcode",
          "system", "vision"}},
    };
    for (const Folder& folder : folders)
        router.getBoth(folder.path, [folder](const Request&) {
            Document document;
            const std::string prefix = folder.path == std::string("/") ? "/" : folder.path + std::string("/");
            for (const char* name : folder.names)
                document.add("rws-resource-li", name).value("name", name).self = prefix + name;
            return Reply::of(std::move(document));
        });
}

} // namespace rapidc::rws
