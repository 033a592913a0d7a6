#include "simpletools.h"
#include "led.hpp"
Led led(8);
int main(){while(1){led.on();pause(100);}}
