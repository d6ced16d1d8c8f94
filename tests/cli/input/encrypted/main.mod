MODULE MainModule
  PROC main()
    WHILE TRUE DO
      work;
    ENDWHILE
  ENDPROC

  PROC counts()
    WHILE TRUE DO
      reg1 := measured(reg1);
    ENDWHILE
  ENDPROC

  PROC busy()
    WHILE TRUE DO
      Incr reg1;
    ENDWHILE
  ENDPROC
ENDMODULE
