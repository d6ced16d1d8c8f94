MODULE Host
  ! main is in the encrypted module
  PROC tellHost()
    ptSend nPlaced;
  ENDPROC
ENDMODULE
