MODULE later_reserved_words
  !@ manual: 1.1.2
  ! BREAK and CONTINUE are instructions since RobotWare 7.12: in .mod files of older systems they may be names.
  VAR bool continue := TRUE;
  RECORD steps
    num continue;
    num count;
  ENDRECORD
  VAR steps last;

  PROC main()
    VAR num break;
    WHILE continue DO
      break := break + 1;
      IF break > 3 AND continue continue := FALSE;
      last.continue := break;
      reg1 := break;
      TPWrite "go on " \Bool:=continue;
      show continue;
      reg1 := continued(continue);
      IF reg1 > 5 THEN
        CONTINUE;
      ENDIF
      IF reg2 > 5 BREAK;
    ENDWHILE
    Undo 3;
  ENDPROC

  PROC show(bool continue)
    IF NOT continue RETURN;
    TPWrite "on";
  ENDPROC

  FUNC num continued(bool go)
    IF go RETURN 1;
    RETURN 0;
  ENDFUNC

  PROC Undo(num count)
    reg3 := count;
  UNDO
    reg3 := 0;
  ENDPROC
ENDMODULE
