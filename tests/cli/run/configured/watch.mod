MODULE WatchModule
  PERS num ready := 0;
  PROC watch()
    WaitUntil ready = 1;
    addMore;
    inFolder;
    ready := 2;
  ENDPROC
ENDMODULE
