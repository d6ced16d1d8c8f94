MODULE Gehäuse(NOSTEPIN,SYSMODULE)
  ! größte Öffnung
  TRAP stopped()
  ENDTRAP
  PROC prüfen
    LOCAL VAR num höhe;
    VAR string pfad := "C:\temp\größe";
    höhe = 5 ! zwei Fehler in einer Zeile
    IF höhe > 2*-3 THEN
      höhe := 1;
    END IF
    FOR i := 1 TO 5 DO
      TPWrite("x"\Num:=höhe);
    ENDFOR
    WHILE höhe < 0
      höhe := höhe + 1;
    ENDWHILE
    unbekannt := 1;
  ENDPROC
ENDMODULE
