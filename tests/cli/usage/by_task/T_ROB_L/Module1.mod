MODULE Module1
  PROC main()
    TPWrite "arm L";
  ENDPROC
ENDMODULE
