MODULE MainModule
  PROC main()
    pick 1;
    pick 2;
    Set doGrip;
    IF soTouch = 0 Set doGrip;
    Search_1D;
    WZDisable zone;
    place;
    ActUnit STN1;
  ENDPROC
  VAR wztemporary zone;
ENDMODULE
