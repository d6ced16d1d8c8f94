#include "tools/lsp/requests.h"

#include "config/json_text.h"
#include "tools/lsp/semantic_tokens.h"

namespace lsp {

void addLanguageCapabilities(Json& offered) {
    offered["completionProvider"] = {{"triggerCharacters", Json::array({"\\", "."})},
                                     {"resolveProvider", true}};
    offered["signatureHelpProvider"] = {{"triggerCharacters", Json::array({"(", ",", "\\"})},
                                        {"retriggerCharacters", Json::array({",", "\\", ")"})}};
    for (const char* name :
         {"hoverProvider", "definitionProvider", "declarationProvider", "typeDefinitionProvider",
          "implementationProvider", "referencesProvider", "documentHighlightProvider",
          "documentSymbolProvider", "workspaceSymbolProvider", "foldingRangeProvider",
          "selectionRangeProvider", "inlayHintProvider", "callHierarchyProvider"})
        offered[name] = true;
    offered["renameProvider"] = {{"prepareProvider", true}};
    offered["codeLensProvider"] = {{"resolveProvider", true}};
    offered["documentLinkProvider"] = {{"resolveProvider", false}};
    offered["semanticTokensProvider"] = semanticTokensProvider();
}

const std::map<std::string_view, RequestHandler>& requests() {
    static const std::map<std::string_view, RequestHandler> all = {
        {"textDocument/formatting", formatting},
        {"textDocument/rangeFormatting", rangeFormatting},
        {"textDocument/onTypeFormatting", onTypeFormatting},
        {"textDocument/codeAction", codeActions},
        {"workspace/willRenameFiles", willRenameFiles},
        {"textDocument/completion", completion},
        {"completionItem/resolve", resolveCompletion},
        {"textDocument/hover", hover},
        {"textDocument/signatureHelp", signatureHelp},
        {"textDocument/definition", definition},
        {"textDocument/declaration", definition},
        {"textDocument/typeDefinition", typeDefinition},
        {"textDocument/implementation", implementation},
        {"textDocument/references", references},
        {"textDocument/documentHighlight", documentHighlight},
        {"textDocument/prepareRename", prepareRename},
        {"textDocument/rename", rename},
        {"textDocument/documentSymbol", documentSymbol},
        {"workspace/symbol", workspaceSymbol},
        {"textDocument/foldingRange", foldingRange},
        {"textDocument/selectionRange", selectionRange},
        {"textDocument/semanticTokens/full", semanticTokensFull},
        {"textDocument/semanticTokens/full/delta", semanticTokensDelta},
        {"textDocument/semanticTokens/range", semanticTokensRange},
        {"textDocument/inlayHint", inlayHint},
        {"textDocument/codeLens", codeLens},
        {"codeLens/resolve", resolveCodeLens},
        {"textDocument/documentLink", documentLink},
        {"textDocument/prepareCallHierarchy", prepareCallHierarchy},
        {"callHierarchy/incomingCalls", incomingCalls},
        {"callHierarchy/outgoingCalls", outgoingCalls},
    };
    return all;
}

} // namespace lsp
