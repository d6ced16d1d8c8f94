#include "tools/rws/file_service.h"

#include "config/letter_case.h"
#include "tools/rws/request_values.h"
#include "tools/service/event_journal.h"

#include <fmt/format.h>

#include <array>

namespace rapidc::rws {

namespace {

using rapid::config::beginsWithName;
using rapid::config::endsWithName;
using rapid::config::sameName;
using service::FileEntry;
using service::FileProblem;
using service::FileResult;

constexpr std::size_t kMostFilesOnPage = 100;

struct ContentType {
    const char *ending, *type;
};
/// Pages of the App SDK lie in HOME/WebApps; everywhere else files are bytes.
constexpr std::array<ContentType, 12> kWebTypes = {{{".html", "text/html;charset=utf-8"},
                                                    {".htm", "text/html;charset=utf-8"},
                                                    {".js", "text/javascript;charset=utf-8"},
                                                    {".mjs", "text/javascript;charset=utf-8"},
                                                    {".css", "text/css;charset=utf-8"},
                                                    {".json", "application/json"},
                                                    {".svg", "image/svg+xml"},
                                                    {".png", "image/png"},
                                                    {".jpg", "image/jpeg"},
                                                    {".gif", "image/gif"},
                                                    {".ico", "image/x-icon"},
                                                    {".woff2", "font/woff2"}}};

std::string contentTypeOf(const std::string& path) {
    const std::string_view plain = std::string_view(path).substr(path.starts_with('$') ? 1 : 0);
    if (beginsWithName(plain, "HOME/WebApps/"))
        for (const ContentType& each : kWebTypes)
            if (endsWithName(path, each.ending)) return each.type;
    return "application/octet-stream";
}

void describe(const FileEntry& file, Entry& entry) {
    entry.value("fs-cdate", service::calendarText(file.created))
        .value("fs-mdate", service::calendarText(file.modified));
    if (!file.isFolder)
        entry.value("fs-size", fmt::format("{}", file.size))
            .value("fs-readonly", file.isReadOnly ? "true" : "false");
}

} // namespace

Reply refuseFile(const FileResult& result) {
    switch (result.problem) {
    case FileProblem::NoPath: return Reply::refuse(ReturnCode::NoPath, result.text);
    case FileProblem::Outside: return Reply::refuse(ReturnCode::BadParameter, result.text);
    case FileProblem::Exists: return Reply::refuse(ReturnCode::Rejected, result.text, 409);
    case FileProblem::TooLarge: return Reply::refuse(ReturnCode::TooLarge, result.text);
    case FileProblem::None:
    case FileProblem::Refused:
    case FileProblem::Failed: break;
    }
    return Reply::refuse(ReturnCode::Rejected, result.text);
}

std::string pathInVolume(std::string_view text) {
    while (text.starts_with('/'))
        text.remove_prefix(1);
    if (beginsWithName(text, "fileservice/")) text.remove_prefix(std::string_view("fileservice/").size());
    while (text.starts_with('/'))
        text.remove_prefix(1);
    return std::string(text);
}

Reply FileService::volumes(const Request& request) const {
    Document document;
    document.place = Document::Place::Resources;
    for (const std::string& name : volumes_.names()) {
        const std::string title = request.dialect == Dialect::V1 ? "$" + name : name;
        Entry& entry = document.add(request.dialect == Dialect::V1 ? "fs-device" : "fs-dir", title);
        entry.self = "/fileservice/" + title;
        const auto [free, total] = volumes_.space(name);
        entry.value("fs-free-space", fmt::format("{}", free))
            .value("fs-total-space", fmt::format("{}", total));
    }
    return Reply::of(std::move(document));
}

Reply FileService::get(const Request& request) const {
    const std::string path = request.parameter("path");
    FileEntry entry;
    if (const FileResult found = volumes_.describe(path, entry); !found.isDone()) return refuseFile(found);
    if (!entry.isFolder) {
        Raw raw;
        raw.contentType = contentTypeOf(path);
        if (const FileResult read = volumes_.read(path, raw.bytes); !read.isDone()) return refuseFile(read);
        return Reply::of(std::move(raw));
    }
    std::vector<FileEntry> entries;
    if (const FileResult listed = volumes_.list(path, entries); !listed.isDone()) return refuseFile(listed);
    ListPage page;
    if (const auto failure = readListPage(request, entries.size(), kMostFilesOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i) {
        Entry& shown = document.add(entries[i].isFolder ? "fs-dir" : "fs-file", entries[i].name);
        shown.self = hrefBelow("/fileservice", path + "/" + entries[i].name);
        describe(entries[i], shown);
    }
    return Reply::of(std::move(document));
}

Reply FileService::put(const Request& request) const {
    bool isNew = false;
    const FileResult written = volumes_.write(request.parameter("path"), request.body, isNew);
    return written.isDone() ? Reply::done(isNew ? 201 : 200) : refuseFile(written);
}

Reply FileService::remove(const Request& request) const {
    const FileResult removed = volumes_.remove(request.parameter("path"));
    return removed.isDone() ? Reply::done() : refuseFile(removed);
}

Reply FileService::create(const Request& request) const {
    const FileResult made = volumes_.makeFolder(request.parameter("path"), fieldOf(request, "fs-newname"));
    return made.isDone() ? Reply::done(201) : refuseFile(made);
}

/// A file, to a path in any volume.
/// The App SDK gives a bare name, or the address of the new file in the file service.
Reply FileService::copy(const Request& request) const {
    const bool overwrite = flagIn(fieldOf(request, "fs-overwrite")).value_or(false);
    const std::string from = request.parameter("path"), name = fieldOf(request, "fs-newname");
    const FileResult copied = beginsWithName(name, "/fileservice/")
                                  ? volumes_.copyTo(from, pathInVolume(name), overwrite)
                                  : volumes_.copy(from, name, overwrite);
    return copied.isDone() ? Reply::done() : refuseFile(copied);
}

Reply FileService::rename(const Request& request) const {
    const FileResult renamed = volumes_.rename(request.parameter("path"), fieldOf(request, "fs-newname"));
    return renamed.isDone() ? Reply::done() : refuseFile(renamed);
}

Reply FileService::act(const Request& request) const {
    const std::string action = request.form.text("fs-action");
    if (sameName(action, "create")) return create(request);
    if (sameName(action, "copy")) return copy(request);
    if (sameName(action, "rename")) return rename(request);
    return Reply::refuse(ReturnCode::BadParameter, "fs-action is create, copy or rename");
}

void FileService::addTo(Router& router, Subscribables&) {
    const std::string all = "/fileservice", each = all + "/{path*}";
    const auto add = [&router](Dialect dialect, Method method, const std::string& pattern, Handler handler) {
        router.add(dialect, {method, pattern, {}, std::move(handler), Where::Disk});
    };
    for (const Dialect dialect : {Dialect::V1, Dialect::V2}) {
        add(dialect, Method::Get, all, [this](const Request& r) { return volumes(r); });
        add(dialect, Method::Get, each, [this](const Request& r) { return get(r); });
        add(dialect, Method::Put, each, [this](const Request& r) { return put(r); });
        add(dialect, Method::Delete, each, [this](const Request& r) { return remove(r); });
    }
    add(Dialect::V1, Method::Post, each, [this](const Request& r) { return act(r); });
    add(Dialect::V2, Method::Post, each + "/create", [this](const Request& r) { return create(r); });
    add(Dialect::V2, Method::Post, each + "/copy", [this](const Request& r) { return copy(r); });
    add(Dialect::V2, Method::Post, each + "/rename", [this](const Request& r) { return rename(r); });
}

} // namespace rapidc::rws
