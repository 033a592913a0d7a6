#include "simpletools.h"
#define DEG "°"
int main(){ int x=70000; long y=3; char a[2]="°±"; print("%d° %s %x\n", x, "é", y); putChar('ü'); print(DEG); /* é */ while(1){ toggle(0); low(1); pause(50);} }
