import sys; sys.path.insert(0,'/tmp/o3d/t')
import pickle, numpy as np, off
from PIL import Image
real=pickle.load(open("/tmp/o3d/off.pkl","rb"))
rows=[np.hstack([real[n][0] for n in ("texture","bgimage","points","lines")])]
from engine3d.compat.open3d import rendering
o=off.run(rendering,["texture","bgimage","points","lines"]); rows.append(np.hstack([o[n][0] for n in o]))
Image.fromarray(np.vstack(rows)).save('/tmp/o3d/w3.png')
