#include "simpletools.h"
class Part{public: virtual void on(int p)=0;};
class Lamp: public Part{public: void on(int p) override {high(p);}};
Lamp lamp;
int main(){Part&l=lamp;while(1){l.on(8);pause(100);}}
