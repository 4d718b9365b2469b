import pickle, numpy as np, sys
sys.path.insert(0,'/tmp/o3d/t')
real=pickle.load(open("/tmp/o3d/off.pkl","rb"))
from engine3d.compat.open3d.rendering import _tone as t, _ktx as k
from engine3d.compat.open3d import rendering
from engine3d.model.materials.colors import srgb_bytes
print(srgb_bytes(t.tone_mapped(np.array([[1.,1,1],[65504]*3,[1e3]*3,[0,65504,65504],[65504,.8,.9]]))).tolist())
import off
orig=k._on_faces
import itertools
best=[]
for sx,sy,sz in itertools.product([1,-1],[1],[1,-1]):
  for swap in (0,1):
    def f(x,y,z,sx=sx,sz=sz,swap=swap):
        x=-x  # undo
        a,c=(z,x) if swap else (x,z)
        return orig(sx*a,y,sz*c)
    k._on_faces=f; k.environment_of_ktx.cache_clear()
    o=off.run(rendering,["mirror","nosun","skybox","white"])
    e={n:np.abs(o[n][0].astype(int)-real[n][0]).mean() for n in o}
    print(sx,sz,swap,{n:round(v,2) for n,v in e.items()})
