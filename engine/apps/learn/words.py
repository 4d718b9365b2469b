"""What the views of a lesson say besides its own texts, in both languages."""

from __future__ import annotations

from .lesson_file import LANGUAGES

#: Texts in English and in French.
WORDS = {
    "step": (
        "step {} of {}",
        "étape {} sur {}",
    ),
    "idea": (
        "The idea",
        "L'idée",
    ),
    "code": (
        "The lines that matter",
        "Les lignes qui comptent",
    ),
    "parameters": (
        "To play with",
        "À essayer",
    ),
    "exercise": (
        "Exercise",
        "Exercice",
    ),
    "answer": (
        "Your answer:",
        "Votre réponse :",
    ),
    "type": (
        "type a number, then Enter",
        "tapez un nombre, puis Entrée",
    ),
    "check": (
        "Check",
        "Vérifier",
    ),
    "right": (
        "Right!",
        "Exact !",
    ),
    "wrong": (
        "Not yet: try again.",
        "Pas encore : essayez à nouveau.",
    ),
    "none": (
        "That is no number.",
        "Ce n'est pas un nombre.",
    ),
    "copied": (
        "The code is in the clipboard.",
        "Le code est dans le presse-papiers.",
    ),
    "print": (
        "engine3d learn {} --code prints the code.",
        "engine3d learn {} --code affiche le code.",
    ),
    "next": (
        "Next: {}",
        "Ensuite : {}",
    ),
    "keys": (
        "`Left Right` steps · `Up Down` value · `N P` lessons · `Home End` · `0–9 "
        "Enter` answer · `C` copy · `H` help · `Q` quit",
        "`Gauche Droite` étapes · `Haut Bas` valeur · `N P` leçons · `Début Fin` · "
        "`0–9 Entrée` réponse · `C` copier · `H` aide · `Q` quitter",
    ),
    "help": (
        "Keys",
        "Touches",
    ),
    "end": (
        "The end of the course",
        "La fin du cours",
    ),
    "after": (
        "You have seen how a 3D engine works, from the lists of a file to a world that "
        "one walks through. What comes next:\n"
        "• your own pictures: engine3d render model.glb -o picture.png\n"
        "• a world to walk in: engine3d run --scene city --camera fps\n"
        "• scenes made by hand: engine3d edit\n"
        "• scenes and games made by programs: the tutorials of the documentation\n"
        "• the real engine, which does all this quickly: its page on architecture",
        "Vous avez vu comment marche un moteur 3D, des listes d'un fichier jusqu'à un "
        "monde où l'on se promène. Pour continuer :\n"
        "• vos propres images : engine3d render modele.glb -o image.png\n"
        "• un monde où marcher : engine3d run --scene city --camera fps\n"
        "• des scènes faites à la main : engine3d edit\n"
        "• des scènes et des jeux faits par programme : les tutoriels de la "
        "documentation\n"
        "• le vrai moteur, qui fait tout cela vite : sa page sur l'architecture",
    ),
}
#: The keys and what they do, for the help.
KEYS = {
    "en": (
        ("Right  Space  Enter", "next step; after the last one the next lesson"),
        ("Left  Backspace", "step before"),
        ("Home  End", "first and last step"),
        ("N  P", "next lesson, the one before"),
        ("Up  Down", "another value of the parameter"),
        ("Tab", "the next parameter"),
        ("0–9  .  −", "write the answer to the exercise"),
        ("Enter", "check the answer"),
        ("C", "copy the code"),
        ("J  K  wheel", "move the page"),
        ("H", "this list"),
        ("Q  Esc", "leave"),
    ),
    "fr": (
        ("Droite  Espace  Entrée", "étape suivante ; après la dernière, leçon suivante"),
        ("Gauche  Retour arrière", "étape précédente"),
        ("Début  Fin", "première et dernière étape"),
        ("N  P", "leçon suivante, leçon précédente"),
        ("Haut  Bas", "une autre valeur du paramètre"),
        ("Tab", "le paramètre suivant"),
        ("0–9  ,  −", "écrire la réponse à l'exercice"),
        ("Entrée", "vérifier la réponse"),
        ("C", "copier le code"),
        ("J  K  molette", "faire défiler la page"),
        ("H", "cette liste"),
        ("Q  Échap", "quitter"),
    ),
}


def say(word: str, language: str, *values: object) -> str:
    """Return a text in a language, with values in their places."""
    return WORDS[word][LANGUAGES.index(language)].format(*values)
