#include "tools/rws/symbol_resources.h"

#include "config/letter_case.h"
#include "tools/rws/path_pattern.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/rws/symbol_text.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::DataPath;
using service::FoundData;
using service::SymbolInfo;

constexpr std::size_t kSymbolsOnPage = 100, kMostSymbolsOnPage = 200;

class DataWatch final : public Watch {
  public:
    DataWatch(service::DataWatches& watches, service::DataWatches::Token token)
        : watches_(watches), token_(token) {}
    ~DataWatch() override { watches_.remove(token_); }
    DataWatch(const DataWatch&) = delete;
    DataWatch& operator=(const DataWatch&) = delete;

  private:
    service::DataWatches& watches_;
    service::DataWatches::Token token_;
};

Entry valueEntry(const char* type, const std::string& url, const std::string& value) {
    Entry entry;
    entry.type = type;
    entry.title = url;
    entry.value("value", value);
    return entry;
}

/// "num{3,4}" -> "num" and its dimensions. False: it is no such text.
bool splitType(std::string text, std::string& name, std::vector<int32_t>& dims) {
    const std::size_t open = text.find('{');
    name = text.substr(0, open);
    if (open == std::string::npos) return !name.empty();
    if (!text.ends_with('}')) return false;
    text = text.substr(open + 1, text.size() - open - 2);
    while (dims.size() < 3) {
        const std::size_t comma = text.find(',');
        const auto dim = wholeIn(text.substr(0, comma), 1, 100'000);
        if (!dim) return false;
        dims.push_back(static_cast<int32_t>(*dim));
        if (comma == std::string::npos) return true;
        text.erase(0, comma + 1);
    }
    return false;
}

} // namespace

void SymbolResources::addTo(Router& router, Subscribables& subscribables) {
    const Handler value = [this](const Request& request) { return this->value(request); };
    const Handler set =
        access_.guarded(Domain::Rapid, [this](const Request& request) { return setValue(request); });
    const Handler properties = [this](const Request& request) { return this->properties(request); };
    const Handler validate = [this](const Request& request) { return this->validate(request); };
    const Handler search = [this](const Request& request) { return this->search(request); };
    const std::string oldData = "/rw/rapid/symbol/data/{symbol*}",
                      newData = "/rw/rapid/symbol/{symbol*}/data";
    router.get(Dialect::V1, oldData, value);
    router.get(Dialect::V2, newData, value);
    for (const char* action : {"set", "setInitValue", "set-init-value"})
        router.action(oldData, action, set);
    // RWS 2.0, too, says ?action=validate, under a path that data may have
    router.post(Dialect::V2, newData, [set, validate](const Request& request) {
        return sameName(request.query.text("action"), "validate") ? validate(request) : set(request);
    });
    router.get(Dialect::V1, "/rw/rapid/symbol/properties/{symbol*}", properties);
    router.get(Dialect::V2, "/rw/rapid/symbol/{symbol*}/properties", properties);
    router.action("/rw/rapid/symbol/data", "validate", validate);
    for (const char* action : {"search-symbols", "search-symbol"})
        router.action("/rw/rapid/symbols", action, search);
    router.post(Dialect::V2, "/rw/rapid/symbols/search", search);
    const auto open = [this](const Request& request, const Changed& changed, Subscription& out) {
        return subscribe(request, changed, out);
    };
    subscribables.add({oldData, "value", true, Dialect::V1, open});
    subscribables.add({newData, "value", true, Dialect::V2, open});
    subscribables.add(
        {"/rw/rapid/symbol/{symbol*}", "value", true, Dialect::V2, open}); // some clients leave "data" out
}

Reply SymbolResources::unknown(const Request& request, const std::string& why) const {
    return request.dialect == Dialect::V1 ? Reply::refuse(ReturnCode::NotFound, why, 400)
                                          : Reply::refuse(ReturnCode::UnknownSymbol, why);
}

Reply SymbolResources::value(const Request& request) {
    const std::optional<DataPath> path = DataPath::read(request.parameter("symbol"));
    if (!path) return unknown(request, "A symbol is RAPID/TASK/MODULE/NAME");
    const FoundData found = findData(controller_, *path);
    if (found.data == nullptr) return unknown(request, found.problem);
    const std::optional<std::string> text = valueOf(found);
    if (!text)
        return Reply::refuse(ReturnCode::BadParameter,
                             std::string("Data of type ") + found.type->name + " have no value");
    Document document;
    document.entries.push_back(valueEntry("rap-data", path->url(), *text));
    return Reply::of(std::move(document));
}

Reply SymbolResources::setValue(const Request& request) {
    const std::optional<DataPath> path = DataPath::read(request.parameter("symbol"));
    if (!path) return unknown(request, "A symbol is RAPID/TASK/MODULE/NAME");
    if (!request.form.has("value")) return badParameter("value", "a value as RAPID text");
    const FoundData found = findData(controller_, *path);
    if (found.data == nullptr) return unknown(request, found.problem);
    if (found.isConstant || found.isProtected)
        return Reply::refuse(ReturnCode::Rejected, path->name + " cannot be changed");
    if (const std::string problem = assign(found, withExponents(request.form.text("value")));
        !problem.empty())
        return Reply::refuse(ReturnCode::BadParameter, path->url() + ": " + problem);
    controller_.core().scheduler().lookAtData(); // subscriptions and interrupts see it now
    return Reply::done();
}

Reply SymbolResources::validate(const Request& request) {
    const std::vector<std::string> symbol = splitPath(request.parameter("symbol")); // RAPID, T_ROB1
    const bool isTask = symbol.size() == 2 && controller_.core().findTask(symbol[1]) != nullptr;
    if (!isTask && taskOf(controller_, request) == nullptr) return noTask(request);
    std::string given = request.form.text("datatype"), name;
    if (given.empty()) given = request.form.text("dattyp");
    std::vector<int32_t> dims;
    if (!splitType(given, name, dims)) return badParameter("datatype", "a data type such as num or num{3}");
    if (!request.form.has("value")) return badParameter("value", "a value as RAPID text");
    const rt::TypeDesc* type = service::typeNamed(controller_, name);
    if (type == nullptr) return badParameter("datatype", "a data type that the program uses");
    const std::string problem = service::checkValue(*type, dims, withExponents(request.form.text("value")));
    return problem.empty() ? Reply::done() : Reply::refuse(ReturnCode::BadParameter, problem);
}

Reply SymbolResources::properties(const Request& request) {
    const std::optional<SymbolInfo> found = symbols_.find(request.parameter("symbol"));
    if (!found) return unknown(request, "There is no symbol " + request.parameter("symbol"));
    Document document;
    document.place = Document::Place::Resources;
    document.entries.push_back(symbolEntry(*found, request.dialect, ""));
    return Reply::of(std::move(document));
}

Reply SymbolResources::search(const Request& request) {
    std::string problem;
    const std::optional<service::SymbolQuery> query = readQuery(request.form, problem);
    if (!query) return Reply::refuse(ReturnCode::BadParameter, problem);
    const std::optional<Page> page = readPage(request, kSymbolsOnPage, kMostSymbolsOnPage);
    if (!page) return Reply::refuse(ReturnCode::BadPage, "start or limit is not a number");
    std::vector<SymbolInfo> found;
    if (!symbols_.search(*query, found))
        return Reply::refuse(ReturnCode::UnknownSymbol, "There is no block " + query->block);
    Document document;
    document.place = Document::Place::Resources;
    const std::size_t end = std::min(found.size(), page->start + page->limit);
    for (std::size_t i = page->start; i < end; ++i)
        document.entries.push_back(symbolEntry(found[i], request.dialect, "-li"));
    if (end < found.size()) {
        const char* path =
            request.dialect == Dialect::V1 ? "symbols?action=search-symbols&" : "symbols/search?";
        document.next = fmt::format("{}start={}&limit={}", path, end, page->limit);
    }
    return Reply::of(std::move(document));
}

std::optional<Failure> SymbolResources::subscribe(const Request& request, const Changed& changed,
                                                  Subscription& out) {
    const std::optional<DataPath> path = DataPath::read(request.parameter("symbol"));
    const FoundData found = path ? findData(controller_, *path) : FoundData{};
    if (found.data == nullptr) return Failure{ReturnCode::UnknownSymbol, "There are no such data"};
    const std::optional<std::string> value = valueOf(found);
    if (!found.isPersistent || !value)
        return Failure{ReturnCode::BadParameter, "Only values of persistents can be subscribed"};
    // clients of the two dialects look for different classes
    const bool old = request.dialect == Dialect::V1;
    const auto entry = [old, url = path->url()](const std::string& text) {
        return old ? valueEntry("rap-data", url, text) : valueEntry("rap-value-ev", "value", text);
    };
    out.initial.push_back(entry(*value));
    const auto token =
        watches_.add(*path, [changed, entry](const std::string& text) { changed(entry(text)); });
    out.watch = std::make_unique<DataWatch>(watches_, token);
    return std::nullopt;
}

} // namespace rapidc::rws
