MODULE work
  PROC main()
    parts := parts + 2;
    WaitTime 1;
    TPWrite "parts " \Num:=parts;
  ENDPROC
ENDMODULE
