#include "simpletools.h"
const int LED = 8;
namespace lamp{void on(int p){high(p);}}
int main(){while(1){lamp::on(LED);pause(100);}}
