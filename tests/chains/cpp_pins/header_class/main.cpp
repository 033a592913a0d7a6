#include "simpletools.h"
#include "led.h"
Led led(8);
int main(){while(1){led.on();pause(100);}}
