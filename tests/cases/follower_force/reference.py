"""Inextensible elastica of unit length and bending stiffness, clamped at the origin: Runge-Kutta of order 4 along the rod, secant."""
import math
def rk4(f, y, s0, s1, n):
    h=(s1-s0)/n; s=s0
    for _ in range(n):
        a=f(s,y); b=f(s+h/2,[y[i]+h/2*a[i] for i in range(len(y))]); c=f(s+h/2,[y[i]+h/2*b[i] for i in range(len(y))]); d=f(s+h,[y[i]+h*c[i] for i in range(len(y))])
        y=[y[i]+h/6*(a[i]+2*b[i]+2*c[i]+d[i]) for i in range(len(y))]; s+=h
    return y
def secant(g,a,b):
    ga,gb=g(a),g(b)
    for _ in range(60):
        if gb==ga or abs(b-a)<1e-14: break
        a,b,ga=b,b-gb*(b-a)/(gb-ga),gb
        gb=g(b)
    return b
N=4000
# y = theta, kappa, x, y ; EI kappa' = fx sin(theta) - fy cos(theta), f the force on the part beyond s
def back(thetaL, force, n=N):
    return rk4(lambda s,y:[y[1], force(s)[0]*math.sin(y[0])-force(s)[1]*math.cos(y[0]), math.cos(y[0]), math.sin(y[0])],[thetaL,0.0,0.0,0.0],1.0,0.0,n)
def tip(thetaL, force):
    th,k,x,y=back(thetaL,force); return (-x,-y,thetaL,k,th)
if __name__=="__main__":
    for F in (2,8,10,20):
        # tip direction along x: follower (0,F); then turn all back by theta0
        th,k,x,y=back(0.0,lambda s:(0.0,F)); c,s=math.cos(-th),math.sin(-th)
        print("follower",F,c*-x-s*-y,s*-x+c*-y,-th,"moment",k)
    for P in (10,19):
        S=0.1
        def miss(a): return back(a,lambda s:(-P*math.cos(a),-P*math.sin(a)+S),1000)[0]
        a=secant(miss,0.01,0.02)
        print("side",P,tip(a,lambda s:(-P*math.cos(a),-P*math.sin(a)+S)))
    def K(k):
        a,b=1.0,math.sqrt(1-k*k)
        while abs(a-b)>1e-15*a and a-b: a,b=(a+b)/2,math.sqrt(a*b)
        return math.pi/(2*a)
    def E(k):
        a,b,c=1.0,math.sqrt(1-k*k),k; s=c*c/2; p=1.0
        while abs(c)>1e-15: a,b,c=(a+b)/2,math.sqrt(a*b),(a-b)/2; s+=p*c*c; p*=2
        return K(k)*(1-s)
    for r in (1.01,1.5,3.0):
        lo,hi=0.0,0.9999
        for _ in range(100):
            m=(lo+hi)/2
            if (2*K(m)/math.pi)**2<r: lo=m
            else: hi=m
        k=lo; print("euler",r,"x",2*E(k)/K(k)-1,"y",2*k/K(k),"angle",2*math.asin(k),"moment",r*math.pi**2/4*2*k/K(k))
    for w in (8.0,12.0):
        # weight (0,-w) per length; rod starts along y
        best=None
        for a0 in [math.pi/2-0.1*i for i in range(1,20)]:
            f=lambda s:(0.0,-w*(1-s))
            try: a=secant(lambda a: back(a,f,600)[0]-math.pi/2,a0,a0-0.01)
            except Exception: continue
            if abs(back(a,f,600)[0]-math.pi/2)<1e-10 and abs(a-math.pi/2)>1e-3 and -math.pi<a<math.pi/2: best=a; break
        a=secant(lambda a: back(a,f)[0]-math.pi/2,best,best+1e-4)
        print("greenhill",w,tip(a,f))
