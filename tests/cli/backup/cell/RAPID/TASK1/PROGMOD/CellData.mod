%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE CellData
  ! shared with T_LAMP: the same module in both tasks
  PERS num nPlaced:=0;
  PERS bool bDone:=FALSE;
  PERS string sStep{2}:=["",""];
ENDMODULE
