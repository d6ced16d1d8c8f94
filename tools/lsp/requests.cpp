#include "tools/lsp/requests.h"

#include "config/json_text.h"

namespace lsp {

void addLanguageCapabilities(Json& offered) {
    (void)offered;
}

const std::map<std::string_view, RequestHandler>& requests() {
    static const std::map<std::string_view, RequestHandler> all = {
        {"textDocument/formatting", formatting},
        {"textDocument/rangeFormatting", rangeFormatting},
        {"textDocument/onTypeFormatting", onTypeFormatting},
        {"textDocument/codeAction", codeActions},
        {"workspace/willRenameFiles", willRenameFiles},
    };
    return all;
}

} // namespace lsp
