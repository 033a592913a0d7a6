#include "simpletools.h"
#define F(x) ((x)+1
int main(){ int n=F(2); high(0); pause(n); }
