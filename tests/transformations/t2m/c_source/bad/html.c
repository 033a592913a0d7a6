<html><body onload="x();">hi</body></html>
