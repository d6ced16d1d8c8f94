MODULE Other
  RECORD part
    num size;
  DRECORD
  VAR part box;
  VAR num myElsewhere := 8;
  LÒOCAL VAR num myHidden <CSE>
;NDMODULE
