if exists('b:did_ftplugin') | finish | endif
let b:did_ftplugin = 1
setlocal comments=:!!,:! commentstring=!\ %s
setlocal expandtab shiftwidth=3 softtabstop=3
setlocal makeprg=rapidc\ check\ % errorformat=%f:%l:%c:\ %trror%m,%f:%l:%c:\ %tarning%m,%f:%l:%c:\ %tote%m,%-G%.%#
let b:match_ignorecase = 1
let b:match_words = '\<IF\>:\<ELSEIF\>:\<ELSE\>:\<ENDIF\>,\<FOR\>:\<ENDFOR\>,\<WHILE\>:\<ENDWHILE\>,\<TEST\>:\<CASE\>:\<DEFAULT\>:\<ENDTEST\>,\<PROC\>:\<ERROR\>:\<UNDO\>:\<ENDPROC\>,\<FUNC\>:\<ERROR\>:\<ENDFUNC\>,\<TRAP\>:\<ENDTRAP\>,\<MODULE\>:\<ENDMODULE\>,\<RECORD\>:\<ENDRECORD\>'
let b:undo_ftplugin = 'setlocal comments< commentstring< expandtab< shiftwidth< softtabstop< makeprg< errorformat<'
