MODULE main
  PROC main()
    MoveL pHome,v100,fine,tGrip;
  ENDPROC
ENDMODULE
