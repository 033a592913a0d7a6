#include "simpletools.h"
#include "fdserial.h"
int main() { fdserial *bt = fdserial_open(9, 8, 0, 9600); fdserial_txChar(bt, 'a'); }
