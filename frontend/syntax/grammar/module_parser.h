#pragma once
// Files and modules (manual 1.1.3).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// file, module, module_attributes, declaration.
class ModuleParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    void parseFile(const LexResult& lexed);
    Expr* parseWholeExpression(const LexResult& lexed);
    Decl* parseDeclaration();

  private:
    static void cutOff(Node& node);
    bool startsMisspeltModule() const;
    void warnOutsideComment(TokenIndex next);
    void skipOutsideModule();
    void skipStraySemicolons();
    void parseModule();
    void parseModuleAttributes(ModuleDecl* module);
    void addAttribute(ModuleDecl* module, TokenIndex token, std::vector<TokenIndex>& seen);
    void fixAttributeOrder(TokenIndex first, std::vector<TokenIndex> words);
    void parseDeclarations(ModuleDecl* module);
    bool retagLastEnd();
    Decl* parseTaskDeclaration();
    Decl* parseScopedDeclaration();
    Decl* parseUnknownDeclaration();
    void skipToDeclaration();

    bool quietOutside_ = false; ///< text between declarations has been reported
    bool outsideCommentShown_ = false;
    size_t openModules_ = 0; ///< modules whose ENDMODULE has not been found
    diag::Diagnostic* lastOrder_ =
        nullptr; ///< module attributes out of order, while nothing else is reported
};

} // namespace rapid::syntax
