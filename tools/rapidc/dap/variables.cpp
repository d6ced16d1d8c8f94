#include "tools/rapidc/dap/variables.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"
#include "runtime/value/value_text.h"
#include "tools/rapidc/dap/routine_constants.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <set>

namespace rapidc::dap {

namespace {

constexpr uint64_t kMostChildren = 100'000; ///< in one answer, when the client does not say how many

/// "list" and 2: "list{2}"; "list{2,*}" and 3: "list{2,3}".
std::string elementExpression(const std::string& array, int32_t index, std::size_t dimensions) {
    const std::size_t star =
        array.empty() || array.back() != '}' ? std::string::npos : array.find(",*", array.rfind('{'));
    std::string text;
    if (star != std::string::npos)
        text = array.substr(0, star) + fmt::format(",{}", index);
    else
        text = array + fmt::format("{{{}", index);
    for (std::size_t k = 1; k < dimensions; ++k)
        text += ",*";
    return text + "}";
}

bool hasChildren(const rt::DebugVariable& variable) {
    if (variable.data == nullptr) return false;
    return !dimensionsOf(variable).empty() || variable.type->kind == rt::DescKind::Record;
}

} // namespace

int64_t Variables::add(Node node) {
    nodes_.emplace(++last_, std::move(node));
    return last_;
}

const Variables::Node& Variables::find(int64_t reference) const {
    const auto found = nodes_.find(reference);
    if (found == nodes_.end())
        throw Refusal(fmt::format(
            "there is no variablesReference {}; they are valid until the program continues", reference));
    return found->second;
}

Json Variables::scopes(rt::Task& task, rt::Frame* frame) {
    Json list = Json::array();
    const auto scope = [&](const char* name, const char* hint, Scope kind, bool expensive) {
        Node node;
        node.scope = kind;
        node.task = &task;
        node.frame = frame;
        const std::size_t count = scopeOf(node).size();
        Json json{{"name", name},
                  {"variablesReference", add(std::move(node))},
                  {"namedVariables", count},
                  {"expensive", expensive}};
        if (hint != nullptr) json["presentationHint"] = hint;
        list.push_back(std::move(json));
    };
    scope("Locals", "locals", Scope::Locals, false);
    scope("Parameters", "arguments", Scope::Parameters, false);
    scope("Module", nullptr, Scope::Module, false);
    scope("Task", nullptr, Scope::Task, true);
    scope("Persistents", nullptr, Scope::Persistents, false);
    return {{"scopes", std::move(list)}};
}

std::vector<Variables::Child> Variables::routineData(const Node& node, bool parameters) const {
    std::vector<Child> list;
    if (node.frame == nullptr) return list;
    for (rt::DebugVariable& variable :
         context_.debugger().locals({rt::placeOf(node.frame), node.frame, false}))
        if (variable.isParameter == parameters)
            list.push_back({variable.name, variable.name, std::move(variable)});
    if (!parameters)
        for (ConstantText& constant :
             constantsOf(context_.program->compilation(), node.task->index(), *node.frame->routine))
            list.push_back({constant.name, constant.name, {}, constant.value, constant.type});
    return list;
}

std::vector<Variables::Child> Variables::scopeOf(const Node& node) const {
    if (node.scope == Scope::Locals || node.scope == Scope::Parameters)
        return routineData(node, node.scope == Scope::Parameters);
    std::vector<Child> list;
    std::set<std::string> hidingAll, hidingOthers; // names of the routine; LOCAL ones of the module
    for (const bool parameters : {true, false})
        for (const Child& child : routineData(node, parameters))
            hidingAll.insert(rt::upperCase(child.name));
    const rt::ProgramTables& tables = context_.controller().tables();
    const auto task = static_cast<int32_t>(node.task->index());
    const std::string module =
        node.frame != nullptr ? node.frame->routine->module : node.task->place().module;
    for (const rt::GlobalDesc* desc : tables.globals())
        if ((desc->flags & rt::kDataLocal) != 0 && rt::sameName(desc->module, module) &&
            tables.isDeclaredIn(*desc, task))
            hidingOthers.insert(rt::upperCase(desc->name));
    for (const rt::GlobalDesc* desc : tables.globals()) {
        if ((desc->flags & rt::kDataPredefined) != 0 || !tables.isDeclaredIn(*desc, task)) continue;
        const bool persistent = desc->kind == rt::kGlobalPersistent;
        const bool own = rt::sameName(desc->module, module);
        const bool local = (desc->flags & rt::kDataLocal) != 0;
        const bool wanted = node.scope == Scope::Persistents ? persistent
                            : node.scope == Scope::Module    ? !persistent && own
                                                             : !persistent && !own && !local;
        if (!wanted) continue;
        const std::string name = rt::upperCase(desc->name);
        const bool hidden = hidingAll.contains(name) || (!own && (local || hidingOthers.contains(name)));
        const std::string expression = hidden ? fmt::format("{}:{}", desc->module, desc->name) : desc->name;
        list.push_back({desc->name, expression, rt::dataOf(*desc)});
    }
    return list;
}

std::vector<rt::DebugVariable> Variables::moduleData(const rt::Task& task, const std::string& module) const {
    std::vector<rt::DebugVariable> list;
    const rt::ProgramTables& tables = context_.controller().tables();
    for (const rt::GlobalDesc* desc : tables.globals()) {
        const bool hidden = (desc->flags & rt::kDataLocal) != 0 && !rt::sameName(desc->module, module);
        if (!hidden && tables.isDeclaredIn(*desc, static_cast<int32_t>(task.index())))
            list.push_back(rt::dataOf(*desc));
    }
    return list;
}

std::vector<Variables::Child> Variables::childrenOf(const Node& node, uint64_t start, uint64_t count) const {
    std::vector<Child> list;
    const rt::DebugVariable& value = node.value;
    const std::vector<int32_t> dims = dimensionsOf(value);
    if (!dims.empty()) {
        const uint64_t end = std::min<uint64_t>(start + count, static_cast<uint64_t>(std::max(dims[0], 0)));
        for (uint64_t i = start; i < end; ++i) {
            const auto index = static_cast<int32_t>(i + 1);
            list.push_back(
                {fmt::format("{{{}}}", index),
                 node.expression.empty() ? "" : elementExpression(node.expression, index, dims.size()),
                 rowOf(value, index)});
        }
        return list;
    }
    const rt::TypeDesc& type = *value.type;
    for (uint32_t i = 0; type.kind == rt::DescKind::Record && i < type.count; ++i) {
        rt::DebugVariable part = value;
        part.type = type.fields[i];
        part.data = static_cast<char*>(value.data) + type.offsets[i];
        part.name = type.fieldNames[i];
        list.push_back(
            {type.fieldNames[i],
             node.expression.empty() ? "" : fmt::format("{}.{}", node.expression, type.fieldNames[i]),
             std::move(part)});
    }
    return list;
}

Json Variables::describe(const rt::DebugVariable& variable, const std::string& expression,
                         std::shared_ptr<void> storage) {
    Json json{
        {"value", rt::valueText(variable)}, {"type", rt::typeName(variable)}, {"variablesReference", 0}};
    if (!hasChildren(variable)) return json;
    Node node;
    node.value = variable;
    node.expression = expression;
    node.storage = std::move(storage);
    const std::vector<int32_t> dims = dimensionsOf(variable);
    if (!dims.empty())
        json["indexedVariables"] = dims[0];
    else
        json["namedVariables"] = variable.type->count;
    json["variablesReference"] = add(std::move(node));
    return json;
}

Json Variables::entry(const Child& child, const std::shared_ptr<void>& storage) {
    Json json = child.text.empty()
                    ? describe(child.value, child.expression, storage)
                    : Json{{"value", child.text}, {"type", child.type}, {"variablesReference", 0}};
    json["name"] = child.name;
    if (!child.expression.empty()) json["evaluateName"] = child.expression;
    Json attributes = Json::array();
    const bool constant = child.value.isConstant || !child.text.empty();
    if (constant) attributes.push_back("constant");
    if (constant || child.value.data == nullptr) attributes.push_back("readOnly");
    if (!attributes.empty()) json["presentationHint"] = {{"attributes", std::move(attributes)}};
    return json;
}

Json Variables::children(const Arguments& arguments) {
    context_.requireStop();
    const Node node = find(arguments.number("variablesReference"));
    const std::string filter = arguments.text("filter", "");
    const int64_t start = arguments.number("start", 0);
    const int64_t count = arguments.number("count", 0);
    if (start < 0 || count < 0) throw Refusal("'start' and 'count' must not be negative");
    if (!filter.empty() && filter != "indexed" && filter != "named")
        throw Refusal(fmt::format("there is no filter '{}'", filter));
    const bool indexed = node.scope == Scope::None && !dimensionsOf(node.value).empty();
    Json list = Json::array();
    if (filter.empty() || (filter == "indexed") == indexed) {
        const auto first = static_cast<uint64_t>(start);
        const uint64_t most = count > 0 ? static_cast<uint64_t>(count) : kMostChildren;
        std::vector<Child> all;
        if (indexed) {
            all = childrenOf(node, first, most);
        } else {
            all = node.scope == Scope::None ? childrenOf(node, 0, 0) : scopeOf(node);
            all.erase(all.begin(),
                      all.begin() + static_cast<std::ptrdiff_t>(std::min<uint64_t>(first, all.size())));
            if (all.size() > most) all.resize(most);
        }
        for (const Child& child : all)
            list.push_back(entry(child, node.storage));
    }
    return {{"variables", std::move(list)}};
}

void Variables::assign(const rt::DebugVariable& variable, const std::string& text) {
    const std::vector<int32_t> dims =
        variable.data != nullptr ? dimensionsOf(variable) : std::vector<int32_t>();
    if (variable.isConstant || dims.empty()) {
        const std::string problem = rt::assignText(variable, rt::trimmed(text));
        if (!problem.empty()) throw Refusal(problem);
        return;
    }
    // A whole array, also one whose dimensions are known at run time only.
    const rt::TypeDesc* const element = &elementTypeOf(variable);
    rt::TypeDesc type{};
    type.name = element->name;
    type.baseName = element->baseName;
    type.kind = rt::DescKind::Array;
    type.count = 1;
    for (std::size_t k = 0; k < dims.size(); ++k) {
        type.dims[k] = dims[k];
        type.count *= static_cast<uint32_t>(dims[k]);
    }
    type.size = type.count * element->size;
    type.fields = &element;
    const bool hasText = element->kind != rt::DescKind::Handle && element->kind != rt::DescKind::Bytes &&
                         element->kind != rt::DescKind::Other;
    const std::string shown = rt::typeName(variable);
    if (!hasText) throw Refusal(fmt::format("'{}' is not a value of type {}", text, shown));
    const std::string problem = rt::writeText(rt::trimmed(text), variable.data, type, shown);
    if (!problem.empty()) throw Refusal(problem);
}

Json Variables::set(const Arguments& arguments) {
    context_.requireStop();
    const Node node = find(arguments.number("variablesReference"));
    const std::string name = arguments.text("name");
    const std::string text = arguments.text("value");
    const Child child = findChild(node, name);
    if (node.storage) throw Refusal("the value of an expression cannot be changed");
    if (!child.text.empty()) throw Refusal(fmt::format("'{}' is a constant", child.name));
    assign(child.value, text);
    return describe(child.value, child.expression);
}

Variables::Child Variables::findChild(const Node& node, const std::string& name) const {
    const std::vector<Child> all =
        node.scope == Scope::None ? childrenOf(node, 0, UINT32_MAX) : scopeOf(node);
    const auto same = [&](const Child& child) { return rt::sameName(child.name, name); };
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end()) throw Refusal(fmt::format("there is no variable '{}'", name));
    return *found;
}

std::string Variables::expressionOf(int64_t reference, const std::string& name) const {
    return findChild(find(reference), name).expression;
}

} // namespace rapidc::dap
