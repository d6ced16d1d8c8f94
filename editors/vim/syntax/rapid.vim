" Vim syntax file: ABB RAPID
if exists('b:current_syntax') | finish | endif
syntax case ignore
syntax keyword rapidConditional IF THEN ELSEIF ELSE ENDIF TEST CASE DEFAULT ENDTEST
syntax keyword rapidRepeat FOR FROM TO STEP DO ENDFOR WHILE ENDWHILE BREAK CONTINUE
syntax keyword rapidException ERROR UNDO BACKWARD RAISE RETRY TRYNEXT
syntax keyword rapidStatement RETURN EXIT GOTO CONNECT WITH
syntax keyword rapidStructure MODULE ENDMODULE PROC ENDPROC FUNC ENDFUNC TRAP ENDTRAP RECORD ENDRECORD ALIAS
syntax keyword rapidStorageClass LOCAL VAR PERS CONST INOUT SYSMODULE NOVIEW NOSTEPIN VIEWONLY READONLY TASK
syntax keyword rapidOperator AND OR XOR NOT DIV MOD
syntax keyword rapidBoolean TRUE FALSE
syntax match rapidType "\<\%(VAR\|PERS\|CONST\|ALIAS\|FUNC\)\s\+\zs\h\w*"
syntax match rapidFunction "\<\%(PROC\|TRAP\)\s\+\zs\h\w*"
syntax match rapidFunction "\<FUNC\s\+\h\w*\s\+\zs\h\w*"
syntax match rapidNumber "\<\d\+\%(\.\d*\)\=\%([eE][+-]\=\d\+\)\=\>\="
syntax match rapidNumber "\%(\w\)\@1<!\.\d\+\%([eE][+-]\=\d\+\)\="
syntax match rapidNumber "\<0[xX]\x\+\>\|\<0[oO]\o\+\>\|\<0[bB][01]\+\>"
syntax match rapidArgument "\\\s*\h\w*"
syntax match rapidLabel "^\s*\h\w*\s*:\ze\%([^=]\|$\)"
syntax match rapidPlaceholder "<\u\{2,3}>"
syntax match rapidEscape contained /""\|\\\\\|\\\x\x/
syntax region rapidString start=/"/ skip=/""/ end=/"\|$/ contains=rapidEscape oneline
syntax match rapidComment "!.*$" contains=rapidTodo,@Spell
syntax match rapidDocumentation "![!@].*$" contains=@Spell
syntax keyword rapidTodo TODO FIXME contained
syntax region rapidHeader start=/\%^%%%/ end=/^%%%/
highlight default link rapidArgument Identifier
highlight default link rapidBoolean Boolean
highlight default link rapidComment Comment
highlight default link rapidConditional Conditional
highlight default link rapidDocumentation SpecialComment
highlight default link rapidEscape SpecialChar
highlight default link rapidException Exception
highlight default link rapidFunction Function
highlight default link rapidHeader PreProc
highlight default link rapidLabel Label
highlight default link rapidNumber Number
highlight default link rapidOperator Operator
highlight default link rapidPlaceholder Error
highlight default link rapidRepeat Repeat
highlight default link rapidStatement Statement
highlight default link rapidStorageClass StorageClass
highlight default link rapidString String
highlight default link rapidStructure Structure
highlight default link rapidTodo Todo
highlight default link rapidType Type
let b:current_syntax = 'rapid'
