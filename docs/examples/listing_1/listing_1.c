#include "simpletools.h"
#include "abdrive.h"

const int leftQTI  = 6;  //Left QTI port
const int rightQTI = 7;  //Right QTI port
const int LED      = 8;  //LED port
const int QTI_T    = 50; //QTI sensor threshold
const int waitTime = 230;//QTI wait time

long GetQTIState(int comPort){
	set_output(comPort, 0b1);
	set_direction(comPort, 0b1);
	waitcnt(waitTime);
	set_direction(comPort, 0b0);
	waitcnt(waitTime);
	long state = get_state(comPort);
	return state;
}

int main(){
	while (1){
		long sLeft  = GetQTIState(leftQTI);
		long sRight = GetQTIState(rightQTI);

		if (sLeft < QTI_T && sRight < QTI_T)
			drive_speed(24, 24); //continue straight
		else if(sLeft < QTI_T && sRight > QTI_T)
			drive_speed(24, 12); //turn left
		else if(sLeft > QTI_T && sRight > QTI_T){
			drive_speed(0, 0);  //stop
			high(LED);          //switch on LED
			pause(1000);         //wait 1s
			low(LED);           //switch off LED
			drive_speed(24, 24);//continue
		}
	}
}
