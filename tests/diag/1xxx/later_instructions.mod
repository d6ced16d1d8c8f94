MODULE instructions_only
  !@ rule: decision 41
  ! Without such names the words are what they are in newer files.
  PROC main()
    FOR i FROM 1 TO 3 DO
      IF i = 2 CONTINUE;
      IF i = 3 THEN
        BREAK;
      ENDIF
    ENDFOR
    BREAK;
    !@ expect @-1:5-10 error[RAP5030]
  ENDPROC
ENDMODULE
