// Values that compiled code leaves to be settled at run time: descriptions of conformant arrays, missing natives.

#include "runtime/abi/support_natives.h"
#include "runtime/host/controller.h"

#include <algorithm>
#include <map>
#include <tuple>

using namespace rt;

namespace {

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
