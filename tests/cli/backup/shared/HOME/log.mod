MODULE log
  PROC main()
    WaitTime 0.5;
    parts := parts + 10;
    WaitUntil FALSE;
  ENDPROC
ENDMODULE
