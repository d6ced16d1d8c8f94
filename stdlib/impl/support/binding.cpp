// What compiled code leaves to be settled at run time: late binding, descriptions of conformant arrays.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/support_natives.h"

#include "stdlib_constants.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

using namespace rt;

namespace {

bool sameName(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool isIdentifier(std::string_view text) {
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '_' || c >= 0x80; });
}

/// One description with the one-element list that it refers to.
struct ArrayDescription {
    const TypeDesc* element = nullptr;
    TypeDesc desc{};
};

/// Descriptions made so far; they stay, because natives may keep them as long as the data.
struct ArrayDescriptions {
    std::map<std::tuple<const TypeDesc*, int32_t, int32_t, int32_t>, ArrayDescription> made;
};

} // namespace

extern "C" {

Status rt_lateLookup(TaskCore* task, int32_t* result, const String* name, const String* table,
                     int32_t count) {
    const std::string_view written = name->view();
    const std::string_view procedure = written.substr(written.find(':') + 1); // npos + 1 is 0: the whole text
    if (!isIdentifier(procedure))
        return lib::fail(task, err::ERR_CALLPROC,
                         "\"" + std::string(written) + "\" is not the name of a procedure");
    for (int32_t i = 0; i < count; ++i) {
        if (!sameName(table[i].view(), procedure)) continue;
        *result = i;
        return kOk;
    }
    return lib::fail(task, err::ERR_REFUNKPRC,
                     "there is no procedure named \"" + std::string(written) + "\"");
}

Status rt_arrayDesc(TaskCore* task, const TypeDesc** result, const TypeDesc* element, int32_t dim1,
                    int32_t dim2, int32_t dim3) {
    auto& all = taskOf(task).controller().service<ArrayDescriptions>().made;
    ArrayDescription& entry = all[{element, dim1, dim2, dim3}];
    if (!entry.element) {
        entry.element = element;
        entry.desc = {element->name,      element->baseName, DescKind::Array, 0,      0,
                      {dim1, dim2, dim3}, &entry.element,    nullptr,         nullptr};
        entry.desc.count = static_cast<uint32_t>(dim1 * std::max(dim2, 1) * std::max(dim3, 1));
        entry.desc.size = entry.desc.count * element->size;
    }
    *result = &entry.desc;
    return kOk;
}

Status rt_notImplemented(TaskCore* task, const String* name) {
    return taskOf(task).fatal(static_cast<int>(EventId::NotImplemented), std::string(name->view()));
}
}
