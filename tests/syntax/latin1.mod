MODULE Größe
  ! Zähler für Stückzahlen
  VAR num nStück:=0;
  VAR string sGruß:="schöne Grüße, 100 % öl";
  PROC Zähle(num übergabe)
    nStück:=nStück+übergabe;
    IF nStück>=10 nStück:=0;
  ENDPROC
ENDMODULE
