" Indentation of RAPID: blocks by their first and last words.
if exists('b:did_indent') | finish | endif
let b:did_indent = 1
setlocal indentexpr=RapidIndent(v:lnum) indentkeys=!^F,o,O,=~endmodule,=~endproc,=~endfunc,=~endtrap,=~endrecord,=~endif,=~endfor,=~endwhile,=~endtest,=~else,=~elseif,=~case,=~default,=~error,=~undo,=~backward
if exists('*RapidIndent') | finish | endif

let s:opens = '^\s*\%(MODULE\|\%(LOCAL\s\+\)\=\%(PROC\|FUNC\|TRAP\|RECORD\)\|TEST\|CASE\|ELSE\|ERROR\|UNDO\|BACKWARD\)\>\|^\s*DEFAULT\s*:\|^\s*\%(IF\|ELSEIF\)\>.*\<THEN\s*\%(!.*\)\=$\|^\s*\%(FOR\|WHILE\)\>.*\<DO\s*\%(!.*\)\=$'
let s:closes = '^\s*\%(END\%(MODULE\|PROC\|FUNC\|TRAP\|RECORD\|IF\|FOR\|WHILE\|TEST\)\|ELSE\|ELSEIF\|CASE\|ERROR\|UNDO\|BACKWARD\)\>\|^\s*DEFAULT\s*:'

function! RapidIndent(lnum) abort
  let previous = prevnonblank(a:lnum - 1)
  if previous == 0 | return 0 | endif
  let indent = indent(previous)
  let before = getline(previous)
  let here = getline(a:lnum)
  if before =~? s:opens && before !~? '\<ELSE\s\+\S.*;' | let indent += shiftwidth() | endif
  if here =~? s:closes | let indent -= shiftwidth() | endif
  return max([indent, 0])
endfunction
