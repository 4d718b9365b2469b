import pickle, numpy as np
real=pickle.load(open("/tmp/o3d/off.pkl","rb"))
print('white bg', real['white'][0][2,2], 'bg', real['bg'][0][2,2], 'unlit col', real['unlit'][0][120,110], 'nopost bg', real['nopost'][0][2,2])
d=real['depthshader'][0]; u,c=np.unique(d.reshape(-1,3),axis=0,return_counts=True); print(u[np.argsort(-c)][:6], np.sort(c)[::-1][:6])
from engine3d.compat.open3d.rendering import _tone as t
from engine3d.model.materials.colors import srgb_bytes
print(srgb_bytes(t.tone_mapped(np.array([[1.,1,1]]))))
def mapped(A,B,C,lum):
    t._TO_AP0,t._AP0_TO_AP1,t._AP1_TO_REC709=A,B,C
    return srgb_bytes(t.tone_mapped(np.array([[1.,1,1],[.2,.5,.8],[0.01,0.033,0.13]])))
noCat_in=t._product(t._inverse(t._AP0_XYZ),t._REC709_XYZ); cat_in=t._TO_AP0
cat_out=t._AP1_TO_REC709; noCat_out=t._product(t._inverse(t._REC709_XYZ),t._AP1_XYZ)
for n,(a,c) in dict(both=(cat_in,cat_out),none=(noCat_in,noCat_out),inn=(cat_in,noCat_out),out=(noCat_in,cat_out)).items(): print(n,mapped(a,t._AP0_TO_AP1,c,None).tolist())
