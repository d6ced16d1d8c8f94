MODULE mainModule
  PROC main()
    ActUnit STN1;
    DeactUnit STN2;
    count 3;
  ENDPROC
ENDMODULE
