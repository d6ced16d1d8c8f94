MODULE later_procedure
  !@ rule: decision 41
  ! A procedure with the name: the instruction cannot be meant in this file.
  PROC main()
    FOR i FROM 1 TO 3 DO
      Continue;
    ENDFOR
    Continue;
  ENDPROC

  PROC Continue()
    Incr reg1;
  ENDPROC
ENDMODULE
