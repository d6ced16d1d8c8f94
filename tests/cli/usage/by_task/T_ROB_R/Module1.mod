MODULE Module1
  PROC main()
    TPWrite "arm R";
  ENDPROC
ENDMODULE
