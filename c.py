import engine3d as e, numpy as np
from engine3d.rendering.renderer import Renderer
import time
t=time.time(); r=Renderer((64,48),color_space="linear"); print('renderer',time.time()-t)
s=e.Scene()
m=e.Mesh([[0,0,0],[.5,0,0],[0,.5,0]],points=[0,1,2],colors=e.linear(np.array([[1,0,0],[0,1,0],[0.5,.5,.5]])))
n=s.add(m)
l=e.Mesh([[-.8,-.8,0],[.8,-.7,0],[-.5,-.5,0.1],[-.5,.8,.1]],lines=[[0,1],[2,3]])
n2=s.add(l)
n3=s.add(e.Mesh([[-.9,.5,0],[-.7,.5,0],[-.7,.9,0]],[[0,1,2]]))
t=time.time()
f=r.render(s,(e.Camera(np.eye(4)),np.eye(4)),mode="unlit",outputs=("color","face_id","object_id","barycentric","ndc_depth","depth"),point_size=5,cull="none")
print(time.time()-t)
for k in f.outputs: print(k, np.unique(getattr(f,k).reshape(-1,getattr(f,k).shape[2] if getattr(f,k).ndim>2 else 1),axis=0)[:12].tolist())
t=time.time()
for i in range(100):
    s=e.Scene(); s.add(e.Mesh(np.random.rand(2000,3),points=np.arange(2000))); r=Renderer((224,224),color_space="linear")
    r.render(s,(e.Camera(np.eye(4)),np.eye(4)),mode="unlit",point_size=5)
print((time.time()-t)*10,'ms each')
