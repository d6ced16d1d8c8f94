MODULE Latin1Old
  PROC main()
    TPWrite "Länge";
  ENDPROC
ENDMODULE
